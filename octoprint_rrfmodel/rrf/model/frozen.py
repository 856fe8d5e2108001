"""Values of the model for others: equal to what they copy, and nobody can change them."""

from __future__ import annotations

from typing import Any, NoReturn


def _refuse(self: Any, *arguments: Any, **named: Any) -> NoReturn:
    raise TypeError("the model is a snapshot and can't be changed; make a copy")


class FrozenDict(dict):  # type: ignore[type-arg]
    """A ``dict`` that stays as it was made."""

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        """Let ``copy.deepcopy`` and ``pickle`` make a ``dict`` that can be changed."""
        return dict, (dict(self),)


class FrozenList(list):  # type: ignore[type-arg]
    """A ``list`` that stays as it was made."""

    __setitem__ = __delitem__ = __iadd__ = __imul__ = _refuse
    append = clear = extend = insert = pop = remove = reverse = sort = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        """Let ``copy.deepcopy`` and ``pickle`` make a ``list`` that can be changed."""
        return list, (list(self),)


def frozen(value: Any) -> Any:
    """Return a value with all below it as ``FrozenDict`` and ``FrozenList``; JSON takes both."""
    if isinstance(value, dict):
        return FrozenDict((name, frozen(below)) for name, below in value.items())
    if isinstance(value, list):
        return FrozenList(map(frozen, value))
    return value
