"""What the floors don't say: circles, sizes, constructors, OctoPrint's private names."""

import ast
import functools
import subprocess
import sys

import pytest

from tests.support.places import ROOT

PACKAGE = "octoprint_rrfmodel"
RRF = f"{PACKAGE}.rrf"
SIMULATOR = f"{PACKAGE}.simulator"
SERIAL = f"{PACKAGE}.link.serial"

FOREIGN = ("octoprint", "flask", "tornado")

CONNECTIONS = ("octoprint.util.comm", "octoprint.plugins.serial_connector")
"""Modules of OctoPrint's that have its serial connection."""

NOT_OCTOPRINTS = {
    # of named tuples
    "_asdict",
    "_replace",
    # of Flask-Login and Werkzeug
    "_get_current_object",
    "_load_user",
}

MOST_LINES = 300
MOST_COLLABORATORS = 6
MOST_BY_POSITION = 3


def files_of(package):
    return sorted((ROOT / package.replace(".", "/")).rglob("*.py"))


def module_of(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_of(path): path for path in files_of(PACKAGE)}
PACKAGES = {module_of(path) for path in files_of(PACKAGE) if path.name == "__init__.py"}


@functools.cache
def tree_of(module):
    return ast.parse(MODULES[module].read_text("utf-8"))


def imports_of(module):
    """Return the absolute names that a module imports, wherever in it that stands."""
    package = module.split(".")
    if module not in PACKAGES:
        package.pop()
    found = set()
    for node in ast.walk(tree_of(module)):
        if isinstance(node, ast.Import):
            found.update(alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else []
            origin = ".".join([*base, *([node.module] if node.module else [])])
            for alias in node.names:
                name = f"{origin}.{alias.name}"
                found.add(name if name in MODULES else origin)
    return found


def is_below(name, package):
    return name == package or name.startswith(package + ".")


def circle_from(module, arrows):
    """Return the modules on a way from one back to itself, ``None`` where there is none."""
    ways, seen = [[module]], set()
    while ways:
        way = ways.pop()
        for target in arrows[way[-1]]:
            if target == module:
                return way
            if target not in seen:
                seen.add(target)
                ways.append([*way, target])
    return None


def test_no_import_runs_in_a_circle():
    """Those for type checkers count, which whoever reads follows too."""
    # what a package's own file hands on is in its modules
    arrows = {
        module: {name for name in imports_of(module) if name in MODULES and name != module}
        for module in MODULES
    }
    circles = {
        tuple(sorted(circle)) for module in MODULES if (circle := circle_from(module, arrows))
    }
    assert circles == set()


@pytest.mark.parametrize("package", [RRF, SIMULATOR])
def test_import_brings_nothing_of_octoprint(package):
    modules = [name for name in MODULES if is_below(name, package) and "__main__" not in name]
    assert modules, "no module found: the test looked in the wrong place"
    script = (
        "import importlib, sys\n"
        f"sys.path.insert(0, {str(ROOT)!r})\n"
        f"for name in {modules!r}: importlib.import_module(name)\n"
        f"print(*sorted({{name.partition('.')[0] for name in sys.modules}} & set({FOREIGN!r})))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == []


def test_pure_half_imports_the_standard_library_alone():
    standard = getattr(sys, "stdlib_module_names", None)
    if standard is None:
        pytest.skip("Python 3.9 has no list of its modules")
    for package, own in ((RRF, (RRF,)), (SIMULATOR, (SIMULATOR, RRF))):
        crossing = [
            f"{module}: {name}"
            for module in MODULES
            if is_below(module, package)
            for name in imports_of(module)
            if name.partition(".")[0] not in standard
            and not any(is_below(name, allowed) for allowed in own)
        ]
        assert crossing == []


def test_modules_are_small():
    sizes = {
        module_of(path): len(path.read_text("utf-8").splitlines()) for path in files_of(PACKAGE)
    }
    assert {name: size for name, size in sizes.items() if size > MOST_LINES} == {}


def test_constructors_take_few_collaborators():
    long = []
    for module in MODULES:
        tree = tree_of(module)
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef) and node.name == "__init__":
                by_position = len(node.args.args) + len(node.args.posonlyargs) - len(["self"])
                by_name = len(node.args.kwonlyargs)
                if by_position > MOST_BY_POSITION or by_position + by_name > MOST_COLLABORATORS:
                    long.append(f"{module}:{node.lineno}: {by_position} and {by_name}")
    assert long == []


def test_octoprints_connection_is_known_to_the_serial_link_alone():
    found = []
    for module in MODULES:
        tree = tree_of(module)
        if is_below(module, SERIAL) or is_below(module, SIMULATOR) or is_below(module, RRF):
            continue
        found += [f"{module}: {name}" for name in imports_of(module) if name in CONNECTIONS]
        found += [
            f"{module}:{node.lineno}: {node.attr}"
            for node in ast.walk(tree)
            if isinstance(node, ast.Attribute)
            and node.attr.startswith("_")
            and not node.attr.startswith("__")
            and not (isinstance(node.value, ast.Name) and node.value.id in ("self", "cls"))
            and node.attr not in NOT_OCTOPRINTS
        ]
    assert found == []
