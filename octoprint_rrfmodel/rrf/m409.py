"""The evaluator of ``M409`` under its public name; the work is done in :mod:`.model.m409`."""

from .model.m409 import answer
from .model.marks import MARKS

__all__ = ["MARKS", "answer"]
