"""A model with a patch of DSF's, by the rules that clients go by (rrf-network.md 9.4)."""

from __future__ import annotations

import copy


def applied(model, patch, path=""):
    """Return a model with a patch, by the rules that clients go by."""
    found = copy.deepcopy(model)
    for name, value in patch.items():
        where = f"{path}.{name}" if path else name
        old = found.get(name)
        if where in ("messages", "job.layers"):
            found[name] = [*(old or []), *value] if value else []
        elif where.startswith("global."):
            found[name] = value
        elif where in ("global", "plugins") and value is not None:
            merged = applied(old or {}, value, where)
            found[name] = {key: member for key, member in merged.items() if member is not None}
        elif isinstance(value, dict) and isinstance(old, dict):
            found[name] = applied(old, value, where)
        elif isinstance(value, list) and isinstance(old, list):
            found[name] = applied_list(old, value, where)
        else:
            found[name] = value
    return found


def applied_list(old, new, path):
    kept = []
    for index, value in enumerate(new):
        before = old[index] if index < len(old) else None
        if isinstance(value, dict) and isinstance(before, dict):
            kept.append(applied(before, value, path))
        elif value == [] and isinstance(before, list):
            kept.append(before)
        else:
            kept.append(value)
    return kept
