"""Scripts of clients: looked at as a whole, in their order, for whoever sends them."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.control.rate import Rate
from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.rrf.script import refusals
from octoprint_rrfmodel.rrf.views.machine import Machine
from octoprint_rrfmodel.web.moonraker.methods import Method, Methods
from octoprint_rrfmodel.web.moonraker.scripts import GcodeScripts
from tests.rrf.klipper import HOST, model_of, world


class Bench:
    """A machine that says what it was sent, and which methods were asked, in their order."""

    def __init__(self):
        self.done = []
        model = model_of()
        self.world = world(model, HOST._replace(macros=("0:/macros/park.g",)))
        commands = SimpleNamespace(
            machine=lambda: Machine(model), rate=Rate(lambda: 0.0), checked=self._checked
        )
        objects = SimpleNamespace(is_connected=lambda: True, world=lambda: self.world)
        link = SimpleNamespace(
            send_later=lambda lines, tags: self.done.append(list(lines)),
            carried=lambda lines, machine: [f"<{line}>" for line in lines],
        )
        self.scripts = GcodeScripts(objects, link, commands)
        self.scripts.attach(
            Methods(
                Method(name, lambda call, name=name: self.done.append(name), "PRINT")
                for name in ("printer.print.pause", "printer.firmware_restart")
            )
        )

    def _checked(self, name, parameters):
        if parameters.get("speed", 0) > 1:
            raise RequestRefused(400, "Too fast.")
        return [name]

    def run(self, script, *permissions):
        allowed = permissions or ("PRINT",)
        self.scripts.run(script, SimpleNamespace(may=lambda permission: permission in allowed))
        return self.done


@pytest.fixture
def bench():
    return Bench()


def test_all_lines_are_one_lot_in_their_order(bench):
    script = "M117 a\nTURN_OFF_HEATERS\nBED_MESH_CLEAR\nPARK S=1\nM117 b"
    assert bench.run(script) == [
        ["M117 a", "<M568 P0 A0>", "<M140 P0 S{-273.15}>", "<mesh>", "<macro> S1", "M117 b"]
    ]


def test_what_is_done_to_a_print_comes_first(bench):
    assert bench.run("PAUSE\nM117 a") == ["printer.print.pause", ["M117 a"]]


@pytest.mark.parametrize(
    "script", ["M117 a\nPAUSE", "RESTART\nM117 a", "RESTART\nRESTART", "M117 a\nFIRMWARE_RESTART"]
)
def test_elsewhere_it_is_refused(bench, script):
    with pytest.raises(RequestRefused, match="first") as refused:
        bench.run(script)
    assert refused.value.status == 400 and bench.done == []


@pytest.mark.parametrize(
    "script",
    [
        "M117 a\nSET_FAN_SPEED FAN=fan SPEED=7",
        "PAUSE\nSET_FAN_SPEED FAN=fan SPEED=7",
        "PAUSE\nNOSUCH",
        "SDCARD_PRINT_FILE FILENAME=a.g\nM117 a",
        *refusals.REFUSALS,
    ],
)
def test_one_refusal_is_of_the_whole_script(bench, script):
    with pytest.raises(RequestRefused, match=r"^[A-Z].*\.$"):
        bench.run(script)
    assert bench.done == []


def test_who_may_not_print_sends_nothing_behind_it(bench):
    with pytest.raises(RequestRefused) as refused:
        bench.run("PAUSE\nM117 a", "PLUGIN_RRFMODEL_CONTROL")
    assert refused.value.status == 403 and bench.done == []


def test_lines_that_a_command_stands_for_count(bench):
    bench.run("\n".join(["TURN_OFF_HEATERS"] * 20))
    with pytest.raises(RequestRefused, match="Too many"):
        bench.run("\n".join(["TURN_OFF_HEATERS"] * 20))
