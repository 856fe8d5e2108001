"""The remaining commands: messages, beeps, power, names, output modes, filaments."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Callable

from ..line.channel import Channel, Outcome
from ..model.build import NO_TAPER
from ..text.command import Command, GCodeError
from ..text.serial_line import COMPATIBILITIES, NO_REPLY

if TYPE_CHECKING:
    from ..core import Core

EMERGENCY = "Emergency Stop! Reset the controller to continue.\n"
RESET_SECONDS = 1.0
"""Time from M999 to the restart (RRF 3.5 GCodes2.cpp:4718)."""


def nothing(board: Core, channel: Channel, command: Command) -> Outcome:
    """Accepted without any effect a host could see."""
    return None


def emergency_stop(board: Core, channel: Channel, command: Command) -> Outcome:
    """M112: everything off; from then on only a few commands are accepted."""
    board.halt()
    board.message(EMERGENCY)
    return None


def restart(board: Core, channel: Channel, command: Command) -> Outcome:
    """M999: no reply; the port goes away and comes back."""
    board.after_seconds(RESET_SECONDS, board.power_cycle)
    return NO_REPLY


def debug(board: Core, channel: Channel, command: Command) -> Outcome:
    """M111: a table; without parameters or with P there is no ok (RRF 3.5 GCodes2.cpp:1914)."""
    if not command.raw or "P" in command:
        board.usb_message("Debugging enabled for modules: none\nDebugging disabled for modules:\n")
        return NO_REPLY
    return None


def display(board: Core, channel: Channel, command: Command) -> Outcome:
    """M117: the text goes to the model, not to USB."""
    board.data["state"]["displayMessage"] = command.unquoted_text()
    board.bump("state")
    return None


def say(board: Core, channel: Channel, command: Command) -> Outcome:
    """M118: P1 to USB, P0 to all."""
    text = command.string("S")
    if text is None:
        raise GCodeError("missing parameter 'S'")
    target = command.integer("P", 0)
    if target == 1:
        board.usb_message(text + "\n")
    elif target == 0:
        board.message(text + "\n")
    return None


def beep(board: Core, channel: Channel, command: Command) -> Outcome:
    """M300: in the model for as long as it sounds."""
    duration = command.integer("P", 100) or 0
    board.data["state"]["beep"] = {
        "duration": duration,
        "frequency": command.integer("S", 4600) or 0,
    }
    board.bump("state")
    board.after_seconds(duration / 1000, lambda: _silence(board))
    return None


def _silence(board: Core) -> None:
    board.data["state"]["beep"] = None
    board.bump("state")


def power_on(board: Core, channel: Channel, command: Command) -> Outcome:
    """M80: with C it sets the port up."""
    state = board.data["state"]
    if "C" in command:
        state.update(atxPower=False, atxPowerPort=command.string("C"), deferredPowerDown=False)
    if state.get("atxPowerPort") is None and board.firmware.at_least(3, 4):
        raise GCodeError("No PS_ON port defined")
    state["atxPower"] = True
    board.bump("state")
    return None


def power_off(board: Core, channel: Channel, command: Command) -> Outcome:
    """M81: with S1 once everything has cooled down."""
    state = board.data["state"]
    if state.get("atxPowerPort") is None and board.firmware.at_least(3, 4):
        raise GCodeError("No PS_ON port defined")
    if command.integer("S", 0) == 1:
        state["deferredPowerDown"] = True
    else:
        state.update(atxPower=False, deferredPowerDown=False)
        board.thermal.all_off()
    board.bump("state")
    return None


def name_machine(board: Core, channel: Channel, command: Command) -> Outcome:
    """M550."""
    name = command.string("P")
    network = board.data.get("network") or {}
    if name is None:
        return f"RepRap name: {network.get('name')}"
    network["name"] = name
    network["hostname"] = re.sub(r"[^A-Za-z0-9]", "", name).lower() or "duet"
    board.bump("network")
    return None


def compatibility(board: Core, channel: Channel, command: Command) -> Outcome:
    """M555: for this channel only."""
    number = command.integer("P")
    if number is None:
        return f"Output mode: {channel.input['compatibility']}"
    if not 0 <= number < len(COMPATIBILITIES):
        raise GCodeError("Invalid output mode")
    channel.input["compatibility"] = COMPATIBILITIES[number]
    board.bump("inputs")
    return None


def identity_transform(board: Core, channel: Channel, command: Command) -> Outcome:
    """M561: bed compensation off."""
    compensation = board.data["move"]["compensation"]
    compensation.update(file=None, fadeHeight=NO_TAPER, meshDeviation=None)
    compensation["type"] = "none"
    if "liveGrid" in compensation:
        compensation["liveGrid"] = None
    board.bump("move")
    return None


def serial_settings(board: Core, channel: Channel, command: Command) -> Outcome:
    """M575 P0 S: whether USB requires a checksum."""
    mode = command.integer("S")
    if command.integer("P", 0) == 0 and mode is not None:
        board.channels["USB"].requires_checksum = bool(mode & 1)
    return None


def cold_extrusion(board: Core, channel: Channel, command: Command) -> Outcome:
    """M302: S sets the temperature, P1 allows cold extrusion."""
    if not command.raw:
        limit = board.data["heat"]["coldExtrudeTemperature"]
        return f"Cold extrusion is denied, min. extrusion temperature {limit:.1f}°C"
    for letter, member in (("S", "coldExtrudeTemperature"), ("R", "coldRetractTemperature")):
        value = command.number_of(letter)
        if value is not None:
            board.data["heat"][member] = value
            board.bump("heat")
    if "P" in command:
        board.cold_extrusion_allowed = command.integer("P", 0) == 1
    return None


def firmware_retraction(board: Core, channel: Channel, command: Command) -> Outcome:
    """G10 without parameters and G11."""
    tool = board.current_tool()
    if tool is not None and "isRetracted" in tool:
        tool["isRetracted"] = command.number == 10
    return None


def spindle(board: Core, channel: Channel, command: Command) -> Outcome:
    """M3, M4, M5: spindle P or the current tool's; M5 without any stops all of them.

    RRF 3.5 GCodes2.cpp (M3, M4, M5), Spindle.cpp, SetRpm: the speed is kept as it was asked for,
    the spindle turns within its limits.
    """
    spindles = board.data.get("spindles") or []
    tool = board.current_tool() or {}
    place = command.integer("P", tool.get("spindle", -1))
    if place is None or not 0 <= place < len(spindles) or spindles[place] is None:
        if command.number != 5 or "P" in command:
            raise GCodeError("No P parameter and no active tool with spindle")
        for other in spindles:
            _turn(other, "stopped")
        return None
    speed = command.integer("S")
    if speed is not None and command.number != 5:
        spindles[place]["active"] = speed
    _turn(spindles[place], {3: "forward", 4: "reverse"}.get(command.number or 5, "stopped"))
    board.bump("spindles")
    return None


def _turn(spindle: dict[str, Any] | None, state: str) -> None:
    if spindle is None or spindle["state"] == "unconfigured":
        return
    turns = state != "stopped" and spindle["active"] > 0
    speed = min(max(spindle["active"], spindle["min"]), spindle["max"])
    spindle.update(state=state, current=speed if turns else 0)


def machine_mode(mode: str) -> Callable[[Core, Channel, Command], Outcome]:
    """Return the command that makes the machine a printer or a router (M451, M453)."""

    def set_mode(board: Core, channel: Channel, command: Command) -> Outcome:
        board.data["state"]["machineMode"] = mode
        board.bump("state")
        return None

    return set_mode


def output_port(board: Core, channel: Channel, command: Command) -> Outcome:
    """M42 and M280: ``state.gpOut``."""
    ports = board.data["state"].get("gpOut") or []
    number, value = command.integer("P", 0) or 0, command.number_of("S", 0.0) or 0.0
    if not 0 <= number < len(ports) or ports[number] is None:
        raise GCodeError(f"GPIO port {number} not found")
    ports[number]["pwm"] = min(1.0, value / 255 if value > 1 else value)
    return None


_ACCEPTED = """
    G11 G17 G18 G19 G53 G60 G80 G93 G94 M17 M73 M110 M150 M200 M201 M203 M204 M205 M207 M260
    M301 M303 M304 M305 M307 M308 M350 M404 M501 M551 M552 M553 M554 M556 M557 M558 M566
    M567 M569 M570 M571 M572 M573 M574 M577 M578 M580 M581 M582 M583 M584 M585 M586 M587
    M588 M589 M591 M592 M593 M595 M665 M666 M667 M668 M669 M671 M675 M851 M905 M906 M911
    M912 M913 M915 M916 M917 M918 M929 M950 M951 M952 M955 M956 M957 M958 M959 M970 M997
"""
"""Configuration that the simulator takes note of in no way."""

TABLE: dict[str, Callable[[Core, Channel, Command], Outcome]] = dict.fromkeys(
    _ACCEPTED.split(), nothing
)
TABLE.update(
    {
        "G11": firmware_retraction,
        "M3": spindle,
        "M4": spindle,
        "M5": spindle,
        "M42": output_port,
        "M80": power_on,
        "M81": power_off,
        "M111": debug,
        "M112": emergency_stop,
        "M117": display,
        "M118": say,
        "M300": beep,
        "M302": cold_extrusion,
        "M451": machine_mode("FFF"),
        "M453": machine_mode("CNC"),
        "M550": name_machine,
        "M555": compatibility,
        "M561": identity_transform,
        "M575": serial_settings,
        "M999": restart,
    }
)
