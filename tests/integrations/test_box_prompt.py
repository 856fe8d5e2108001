"""Boxes in OctoPrint's bundled plugin for prompts, and its answers on their way to the machine."""

import logging
from types import SimpleNamespace

import pytest
from octoprint.plugins.action_command_prompt import ActionCommandPromptPlugin

from octoprint_rrfmodel.integrations.box_prompt import (
    ACTION_HOOK,
    CAPABILITY_HOOK,
    BoxPrompt,
    handler_of,
)
from octoprint_rrfmodel.rrf.gcode.operations import Lines

BOX = {"mode": 3, "seq": 7, "title": "Bed", "message": "Is it clear?"}
USB = {"name": "USB", "state": "awaitingAcknowledgement"}


class Rig:
    """The bundled plugin itself, beside a model and settings that the test turns."""

    def __init__(self, version="3.5.3"):
        self.pushed = []
        self.commands = []
        self.plugin = ActionCommandPromptPlugin()
        self.plugin._identifier = "action_command_prompt"
        self.plugin._logger = logging.getLogger("tests.prompt")
        self.plugin._command = "M876"
        self.plugin._plugin_manager = SimpleNamespace(
            send_plugin_message=lambda name, data: self.pushed.append(data)
        )
        self.plugin._printer = SimpleNamespace(
            commands=lambda lines, **others: self.commands.extend(lines)
        )
        self.hooks = {
            ACTION_HOOK: self.plugin.action_command_handler,
            CAPABILITY_HOOK: self.plugin.firmware_capability_handler,
        }
        self.link = SimpleNamespace(connection=object())
        self.is_on = True
        self.model = {"boards": [{"firmwareVersion": version}], "state": {}}
        self.prompt = BoxPrompt(
            lambda hook: self.hooks.get(hook),
            self.link,
            model=lambda: self.model,
            is_on=lambda: self.is_on,
        )

    def show(self, box, **keys):
        """Let the model have that box; return what the plugin pushes because of it."""
        self.model = {**self.model, "state": {"messageBox": box}, **keys}
        self.pushed = []
        self.prompt.look()
        return self.pushed

    def press(self, choice):
        """Press a button of the dialog; return what goes out in the place of its command."""
        self.commands = []
        self.plugin._answer_prompt(choice)
        (command,) = self.commands
        return self.prompt.translate(command, "M876")


SHOWN = {"action": "show", "text": "Bed: Is it clear?", "choices": ["OK", "Cancel"]}
CLOSED = {"action": "close"}


def test_shows_a_box_once_and_closes_it():
    rig = Rig()
    assert rig.show(None) == []
    assert rig.show(BOX) == [SHOWN]
    assert rig.show(dict(BOX)) == []
    assert rig.show(None) == [CLOSED]
    assert rig.show(None) == []


def test_next_box_takes_the_place():
    rig = Rig()
    rig.show(BOX)
    closed, shown = rig.show({**BOX, "seq": 8, "mode": 1, "message": "Gone"})
    assert closed == CLOSED
    assert shown == {"action": "show", "text": "Bed: Gone", "choices": ["Close"]}


@pytest.mark.parametrize("version, line", [("3.5.3", "M292 P1 S7"), ("3.3", "M292 P1")])
def test_button_becomes_an_answer(version, line):
    rig = Rig(version)
    rig.show(BOX)
    assert rig.press(1) == Lines((line,))
    # the dialog has closed itself; the box is gone with a later reply
    assert rig.show(None) == []


def test_answer_to_a_box_that_is_gone_is_not_sent():
    rig = Rig()
    rig.show(BOX)
    rig.model = {**rig.model, "state": {"messageBox": {**BOX, "seq": 8}}}
    assert rig.press(0) == Lines()


@pytest.mark.parametrize("command", ["M876 P1", "M876", "M876 S9", "M876 S-1", "M876 S0"])
def test_no_answer_is_not_sent(command):
    rig = Rig()
    if command != "M876 S0":
        rig.show(BOX)
    assert rig.prompt.translate(command, "M876") == Lines()


def test_other_commands_are_none_of_its_business():
    assert Rig().prompt.translate("M292 P0", "M292") is None


def test_text_alone_where_the_firmware_takes_no_answer():
    rig = Rig("3.5.3")
    assert rig.show(BOX, inputs=[USB]) == [{**SHOWN, "choices": []}]


def test_switched_off():
    rig = Rig()
    rig.is_on = False
    assert rig.show(BOX) == []
    assert rig.prompt.translate("M876 S0", "M876") is None
    rig.is_on = True
    assert rig.show(BOX) == [SHOWN]
    rig.is_on = False
    assert rig.show(BOX) == [CLOSED]


def test_says_once_a_connection_that_prompts_are_understood():
    rig = Rig()
    rig.show(BOX)
    rig.show({**BOX, "seq": 8})
    # what the bundled plugin asks of a printer that said so, and RepRapFirmware doesn't know
    assert rig.commands == ["M876 P1"]
    assert rig.prompt.translate(*rig.commands, "M876") == Lines()
    rig.link.connection = object()
    rig.show({**BOX, "seq": 9})
    assert rig.commands == ["M876 P1"] * 2


def test_prompt_of_the_printers_own_makes_way():
    rig = Rig()
    rig.plugin._cap_prompt_support = True
    for action in ("prompt_begin Old", "prompt_show"):
        rig.plugin.action_command_handler(rig.link.connection, "", action)
    assert rig.show(BOX)[-1] == SHOWN


def test_without_the_bundled_plugin_nothing_happens():
    rig = Rig()
    rig.hooks = {}
    assert rig.show(BOX) == []
    assert rig.show(None) == []
    assert rig.prompt.translate("M876 S0", "M876") == Lines()


def test_disconnected():
    rig = Rig()
    rig.show(BOX)
    rig.link.connection = None
    rig.model = {}
    rig.pushed = []
    rig.prompt.look()
    assert rig.pushed == [CLOSED]


@pytest.mark.parametrize("state", [None, 7, {"messageBox": 7}, {"messageBox": {"mode": 2}}])
def test_nonsense_is_no_box(state):
    rig = Rig()
    rig.model = {**rig.model, "state": state}
    rig.prompt.look()
    assert rig.pushed == []


def test_handler_is_looked_up():
    hooks = {ACTION_HOOK: {"other": print, "action_command_prompt": repr}}
    manager = SimpleNamespace(get_hooks=lambda hook: hooks.get(hook, {}))
    find = handler_of(lambda: manager)
    assert find(ACTION_HOOK) is repr
    assert find(CAPABILITY_HOOK) is None
