"""The machine's power supply as PSUControl sees it."""

import pytest

from octoprint_rrfmodel.integrations.psu import METHODS, PowerSupply, register


@pytest.mark.parametrize("method, on", [("turn_psu_on", True), ("turn_psu_off", False)])
def test_switches_by_command(method, on):
    commands = []
    supply = PowerSupply(lambda name, **parameters: commands.append((name, parameters)), dict)
    getattr(supply, method)()
    assert commands == [("power", {"on": on})]


def test_refusal_reaches_who_switches():
    def refuse(name, **parameters):
        raise ValueError("Not while the machine prints.")

    with pytest.raises(ValueError, match="Not while"):
        PowerSupply(refuse, dict).turn_psu_off()


@pytest.mark.parametrize(
    "model, is_on",
    [
        ({"state": {"atxPower": True}}, True),
        ({"state": {"atxPower": False}}, False),
        ({"state": {"atxPower": None}}, False),
        ({"state": {}}, False),
        ({"state": None}, False),
        ({}, False),
    ],
    ids=repr,
)
def test_state(model, is_on):
    assert PowerSupply(print, lambda: model).get_psu_state() is is_on


class Plugin:
    """Stands for the plugin's implementation, which PSUControl looks for."""


class Plugins:
    """OctoPrint's answers to who asks for a plugin's helpers."""

    def __init__(self, helpers):
        self._helpers = helpers

    def get_helpers(self, name, *names):
        assert name == "psucontrol"
        return self._helpers


def test_registers_the_plugin_itself():
    registered = []
    plugin, supply = Plugin(), PowerSupply(print, lambda: {"state": {"atxPower": True}})
    assert register(Plugins({"register_plugin": registered.append}), plugin, supply)
    assert registered == [plugin]
    assert all(callable(getattr(plugin, name)) for name in METHODS)
    assert plugin.get_psu_state() is True


@pytest.mark.parametrize("helpers", [None, {}], ids=["no PSUControl", "an old one"])
def test_nobody_to_register_with(helpers):
    plugin = Plugin()
    assert not register(Plugins(helpers), plugin, PowerSupply(print, dict))
    assert not hasattr(plugin, "turn_psu_on")
