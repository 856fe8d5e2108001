"""The simulator is built in floors: no circle of imports, no part that is given everything."""

from __future__ import annotations

import ast
import functools
import pathlib
import re

import pytest

from octoprint_rrfmodel import simulator

PACKAGE = simulator.__name__
ROOT = pathlib.Path(simulator.__file__).parent
MOST_COLLABORATORS = 6
MOST_FILES = 24
MOST_LINES = 300
FLOORS = re.findall(r"^\* ((?:``\w+``(?:, )?)+):", simulator.__doc__, re.MULTILINE)
FLOOR_OF = {
    name: number for number, floor in enumerate(FLOORS) for name in re.findall(r"\w+", floor)
}


def name_of(path):
    """Return the module's name without the package: ``device.motion``, ``device``, or nothing."""
    parts = list(path.relative_to(ROOT).with_suffix("").parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {name_of(path): path for path in sorted(ROOT.rglob("*.py"))}


def imported(module, tree, modules):
    """Return the modules of the simulator that this one imports, wherever the import stands."""
    package = module.split(".") if MODULES.get(module, ROOT).name == "__init__.py" else None
    package = package if package is not None else module.split(".")[:-1]
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            wanted = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                above = [part for part in package if part][: len(package) - node.level + 1]
                base = ".".join([PACKAGE, *above, *filter(None, [node.module])])
            # "from ..device import job" brings a module, "from ..clock import Clock" a name of one
            wanted = [f"{base}.{alias.name}" for alias in node.names] + [base]
        else:
            continue
        for name in wanted:
            inside = name[len(PACKAGE) + 1 :] if name.startswith(PACKAGE + ".") else None
            if inside in modules and inside != module:
                found.add(inside)
    return found


@functools.cache
def tree_of(module):
    return ast.parse(MODULES[module].read_text(encoding="utf-8"))


@functools.cache
def all_imports():
    """Return by module which others it imports."""
    return {name: imported(name, tree_of(name), MODULES) for name in MODULES}


def circle_in(imports):
    """Return the modules of one circle in the order of their imports, nothing without any."""
    done, under_way = set(), []

    def visit(module):
        if module in under_way:
            return [*under_way[under_way.index(module) :], module]
        if module in done:
            return []
        under_way.append(module)
        for other in sorted(imports[module]):
            circle = visit(other)
            if circle:
                return circle
        under_way.pop()
        done.add(module)
        return []

    for module in sorted(imports):
        circle = visit(module)
        if circle:
            return circle
    return []


def constructors(tree):
    """Return class → names of what its constructor is given, ``self`` left out."""
    found = {}
    for node in ast.walk(tree):
        if not isinstance(node, ast.ClassDef):
            continue
        for method in node.body:
            if isinstance(method, ast.FunctionDef) and method.name == "__init__":
                given = method.args
                arguments = [*given.posonlyargs, *given.args, *given.kwonlyargs]
                rest = [given.vararg, given.kwarg]
                found[node.name] = [a.arg for a in [*arguments, *filter(None, rest)]][1:]
    return found


def test_a_circle_is_found():
    """The search sees what it is here for, under ``TYPE_CHECKING`` and in a function too."""
    hidden = "if TYPE_CHECKING:\n    from ..clock import Clock\n"
    late = "def f():\n    from . import motion\n"
    assert imported("device.card", ast.parse(hidden), MODULES) == {"clock"}
    assert imported("device.card", ast.parse(late), MODULES) >= {"device.motion"}
    assert circle_in({"a": {"b"}, "b": {"c"}, "c": {"b"}}) == ["b", "c", "b"]
    assert circle_in({"a": {"b", "c"}, "b": {"c"}, "c": set()}) == []


def test_no_circle():
    assert all_imports()["board"] >= {"assembly", "line.usb_input"}, "imports aren't seen"
    assert circle_in(all_imports()) == []


def test_no_import_only_for_types():
    """What a part is given it may import; a name that it can't is one from above."""
    hiding = [
        name
        for name, path in MODULES.items()
        if "TYPE_CHECKING" in path.read_text(encoding="utf-8")
    ]
    assert hiding == []


def floor_of(module):
    return FLOOR_OF[module.split(".")[0]]


def test_imports_only_go_down():
    assert {module.split(".")[0] for module in MODULES if module} == set(FLOOR_OF)
    uphill = [
        f"{module} imports {other}"
        for module, others in all_imports().items()
        for other in others
        if floor_of(other) > floor_of(module)
    ]
    assert uphill == []


@pytest.mark.parametrize("module", [name for name in MODULES if name])
def test_constructors_take_few_collaborators(module):
    for name, given in constructors(tree_of(module)).items():
        assert len(given) <= MOST_COLLABORATORS, f"{name} takes {', '.join(given)}"


def test_constructors_are_seen():
    assert constructors(tree_of("device.power")) == {"Power": ["model", "motion"]}
    assert len(constructors(tree_of("device.job"))["Job"]) == 5


NETWORK = {f"network.{name}" for name in ("network_face", "http_board", "sbc_board")}


def test_no_part_is_given_the_whole():
    """Only faces have a board, and who makes one; only the board is the assembly."""
    having = {module for module, others in all_imports().items() if others & {"board", "assembly"}}
    assert having == {"board", "port", "pty", *NETWORK, "replay", "__main__"}


def test_folders_and_modules_are_small():
    for folder in [ROOT, *(path for path in ROOT.rglob("*") if path.is_dir())]:
        assert len(list(folder.glob("*.py"))) <= MOST_FILES, folder
    for path in MODULES.values():
        assert len(path.read_text(encoding="utf-8").splitlines()) <= MOST_LINES, path


def test_each_name_means_one_thing():
    names = [name.rpartition(".")[2] for name in MODULES]
    assert sorted(names) == sorted(set(names))
