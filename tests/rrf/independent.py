"""A merge and a comparison written once more, the plain way, to check the real ones against."""

import copy


def overlaid(old, new):
    """Return ``old`` with a patch laid over it; nothing is shared with either."""
    if type(old) is dict and type(new) is dict:
        merged = copy.deepcopy(old)
        for name in new:
            merged[name] = (
                overlaid(old[name], new[name]) if name in old else copy.deepcopy(new[name])
            )
        return merged
    if type(old) is list and type(new) is list:
        return [
            overlaid(old[index], item) if index < len(old) else copy.deepcopy(item)
            for index, item in enumerate(new)
        ]
    return copy.deepcopy(new)


def same(one, other):
    """Return whether two values are the same JSON: ``true`` isn't 1, but 0 is 0.0."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(same(one[name], other[name]) for name in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, (dict, list)) or isinstance(other, (dict, list)):
        return False
    return isinstance(one, bool) is isinstance(other, bool) and one == other


def differing(old, new, path=""):
    """Yield the path of each value that is in one of two values only, or not the same in both."""
    if isinstance(old, dict) and isinstance(new, dict):
        for name in old.keys() | new.keys():
            below = f"{path}.{name}" if path else name
            if name in old and name in new:
                yield from differing(old[name], new[name], below)
            else:
                yield below
    elif isinstance(old, list) and isinstance(new, list):
        for index in range(max(len(old), len(new))):
            if index < len(old) and index < len(new):
                yield from differing(old[index], new[index], f"{path}[{index}]")
            else:
                yield f"{path}[{index}]"
    elif not same(old, new):
        yield path
