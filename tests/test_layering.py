"""The borders: rrf needs the standard library alone, the simulator that and rrf."""

import ast
import importlib.util
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

from tests.support.places import ROOT

PACKAGE = "octoprint_rrfmodel"
RRF = f"{PACKAGE}.rrf"
SIMULATOR = f"{PACKAGE}.simulator"

# package -> the packages of the project that its modules may import from
MAY_IMPORT = {RRF: (RRF,), SIMULATOR: (SIMULATOR, RRF)}

FOREIGN = ("octoprint", "flask", "tornado")

MAX_LINES = 300
# module -> why it reads better in one piece
LONG_FOR_A_REASON = {}


def files_of(package):
    return sorted((ROOT / package.replace(".", "/")).rglob("*.py"))


def module_of(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports_of(path):
    """Return ``(line, absolute name)`` of each import, wherever in the module it stands."""
    package = module_of(path).split(".")
    if path.name != "__init__.py":
        package.pop()
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found += [(node.lineno, alias.name) for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            found.append((node.lineno, node.module))
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1]
            names = [node.module] if node.module else [alias.name for alias in node.names]
            found += [(node.lineno, ".".join([*base, name])) for name in names]
    return found


def is_standard(name):
    """Return whether the module comes with Python."""
    top = name.partition(".")[0]
    # Python 3.9 has no list of them
    if hasattr(sys, "stdlib_module_names"):
        return top in sys.stdlib_module_names
    spec = importlib.util.find_spec(top)
    origin = spec.origin if spec else None
    if origin in ("built-in", "frozen"):
        return True
    standard = Path(sysconfig.get_path("stdlib"))
    return origin is not None and standard in Path(origin).parents and "-packages" not in origin


def is_below(name, package):
    return name == package or name.startswith(package + ".")


@pytest.mark.parametrize(
    ("package", "path"),
    [(package, path) for package in MAY_IMPORT for path in files_of(package)],
    ids=lambda value: module_of(value) if isinstance(value, Path) else "",
)
def test_module_stays_on_its_side(package, path):
    crossing = [
        f"line {line}: {name}"
        for line, name in imports_of(path)
        if not is_standard(name)
        and not any(is_below(name, allowed) for allowed in MAY_IMPORT[package])
    ]
    assert not crossing


@pytest.mark.parametrize("package", MAY_IMPORT)
def test_import_brings_nothing_of_octoprint(package):
    modules = [module_of(path) for path in files_of(package) if path.name != "__main__.py"]
    script = (
        "import importlib, sys\n"
        f"sys.path.insert(0, {str(ROOT)!r})\n"
        f"for name in {modules!r}: importlib.import_module(name)\n"
        f"print(*sorted({{name.partition('.')[0] for name in sys.modules}} & set({FOREIGN!r})))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == []


def test_border_is_watched():
    assert files_of(RRF), "no module found: the tests above looked in the wrong place"


def test_modules_are_small():
    long = {
        module_of(path): lines
        for path in files_of(PACKAGE)
        if (lines := len(path.read_text(encoding="utf-8").splitlines())) > MAX_LINES
    }
    assert long.keys() - LONG_FOR_A_REASON.keys() == set(), f"over {MAX_LINES} lines: {long}"
    assert LONG_FOR_A_REASON.keys() - long.keys() == set(), "no longer long"
