"""Where things lie in the project, wherever the module that asks lies."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
