"""Commands that only tell: temperatures, position, firmware, endstops, object model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..line.channel import Channel, Outcome, Running
from ..model.om import OUT_OF_BUFFERS, dsf_reply
from ..text.command import Command, GCodeError
from ..text.serial_line import NO_REPLY, Kind, Reply
from .m408 import forms as m408

if TYPE_CHECKING:
    from ..core import Core

KEY_LENGTH = 100
FLAGS_LENGTH = 20
"""Longest K and F of M409 (RRF 3.5 GCodes2.cpp:3111)."""


def temperatures(board: Core) -> str:
    """Return ``T:21.3 /0.0 T0:21.3 /0.0 B:60.0 /60.0`` (RRF 3.5 GCodes.cpp:4811-4861)."""
    current = board.current_tool()
    found: list[str] = []
    if current is not None and current.get("heaters"):
        found.append("T:" + _heaters(board, current["heaters"]))
    for tool in board.tools():
        if tool.get("heaters"):
            found.append(f"T{tool['number']}:" + _heaters(board, tool["heaters"]))
    heat = board.data.get("heat") or {}
    for letter, slots in (("B", heat.get("bedHeaters")), ("C", heat.get("chamberHeaters"))):
        for slot, index in enumerate(slots or ()):
            if board.thermal.heater(index) is None:
                break  # the list ends at the first slot without a heater
            found.append(f"{letter}{slot or ''}:" + _heaters(board, [index]))
    return " ".join(found)


def _heaters(board: Core, indexes: list[int]) -> str:
    pairs = []
    for index in indexes:
        heater = board.thermal.heater(index)
        if heater is not None:
            pairs.append(f"{heater['current']:.1f} /{board.thermal.target(heater):.1f}")
    return " ".join(pairs)


def report_temperatures(board: Core, channel: Channel, command: Command) -> Outcome:
    """M105."""
    channel.status_request = "M105"
    return Reply(temperatures(board), Kind.TEMPERATURES)


def position(board: Core, channel: Channel, command: Command) -> Outcome:
    """M114 (RRF 3.5 GCodes.cpp:3332)."""
    board.refresh()
    axes = [axis for axis in board.motion.axes if axis.get("visible", True)]
    user = " ".join(f"{axis['letter']}:{axis['userPosition']:.3f}" for axis in axes)
    drives = " ".join(
        f"E{index}:{extruder['position']:.1f}"
        for index, extruder in enumerate(board.motion.extruders)
    )
    counts = " ".join(str(round(axis["machinePosition"] * axis["stepsPerMm"])) for axis in axes)
    machine = " ".join(f"{axis['machinePosition']:.3f}" for axis in axes)
    extrusion = f"E:{board.motion.virtual_e:.3f} {drives}".rstrip()
    return f"{user} {extrusion} Count {counts} Machine {machine} Bed comp 0.000"


def identify(board: Core, channel: Channel, command: Command) -> Outcome:
    """M115: no Cap: lines in any version (RRF 3.5 GCodes2.cpp:1944-1984)."""
    firmware, mainboard = board.firmware, board.mainboard
    text = (
        f"FIRMWARE_NAME: {mainboard.firmware_name} FIRMWARE_VERSION: {firmware.version} "
        f"ELECTRONICS: {mainboard.electronics} FIRMWARE_DATE: {firmware.date}{firmware.time}"
    )
    if firmware.m115_date_twice:
        text += f" FIRMWARE_DATE: {firmware.date}{firmware.time}"
    return text


def endstops(board: Core, channel: Channel, command: Command) -> Outcome:
    """M119 (RRF 3.5 EndstopsManager.cpp:519)."""
    found = board.data["sensors"].get("endstops") or []
    states = []
    for index, axis in enumerate(board.motion.axes):
        endstop = found[index] if index < len(found) else None
        if endstop is None:
            text = "no endstop"
        elif endstop.get("triggered"):
            text = "at max stop" if endstop.get("highEnd") else "at min stop"
        else:
            text = "not stopped"
        states.append(f"{axis['letter']}: {text}")
    return f"Endstops - {', '.join(states)}, Z probe: {_probe_state(board)}"


def _probe_state(board: Core) -> str:
    probes = board.data["sensors"].get("probes") or []
    if not probes or probes[0] is None:
        return "not stopped"
    value = (probes[0].get("value") or [0])[0]
    return "at min stop" if value >= probes[0].get("threshold", 500) else "not stopped"


def diagnostics(board: Core, channel: Channel, command: Command) -> Outcome:
    """M122: many lines."""
    firmware, mainboard = board.firmware, board.mainboard
    minutes, seconds = divmod(int(board.up_time), 60)
    hours, minutes = divmod(minutes, 60)
    board_line = (
        f"{mainboard.firmware_name} version {firmware.version} ({firmware.date}) "
        f"running on {mainboard.electronics}"
    )
    lines = [
        "=== Diagnostics ===",
        board_line,
        f"Board ID: {mainboard.unique_id}",
        f"Used output buffers: 1 of {mainboard.buffers(firmware)} (17 max)",
        "=== RTOS ===",
        "Never used RAM 118392, free system stack 204 words",
        "=== Platform ===",
        f"Last reset {hours:02d}:{minutes:02d}:{seconds:02d} ago, cause: power up",
        "=== Storage ===",
        "Free file entries: 20",
        "=== Move ===",
        f"DMs created 125, segments created 0, maxWait 0ms, bed compensation in use: "
        f"{board.data['move']['compensation']['type']}",
        "=== GCodes ===",
    ]
    for _index, gcode_input in enumerate(board.data["inputs"]):
        if gcode_input is not None:
            lines.append(f"{gcode_input['name']} is {gcode_input['state']} in state(s) 0")
    return Reply("\n".join(lines) + "\n", Kind.LONG)


def speed_factor(board: Core, channel: Channel, command: Command) -> Outcome:
    """M220."""
    move = board.data["move"]
    percent = command.number_of("S")
    if percent is None:
        return f"Speed factor: {move['speedFactor'] * 100:.1f}%"
    if percent < 1:
        raise GCodeError("Invalid speed factor")
    move["speedFactor"] = percent / 100
    board.bump("move")
    return None


def extrusion_factor(board: Core, channel: Channel, command: Command) -> Outcome:
    """M221: with D one extruder, otherwise those of the current tool."""
    percent, drive = command.number_of("S"), command.integer("D")
    extruders = board.motion.extruders
    if drive is not None:
        drives = [drive] if 0 <= drive < len(extruders) else []
        head = f"Extrusion factor for extruder {drive}: "
    else:
        tool = board.current_tool()
        if tool is None:
            raise GCodeError("No tool selected")
        drives = tool.get("extruders") or []
        head = "Extrusion factor(s) for current tool: "
    if percent is None:
        return head + ", ".join(f"{extruders[i]['factor'] * 100:.1f}%" for i in drives)
    for index in drives:
        extruders[index]["factor"] = percent / 100
    board.bump("move")
    return None


def object_model(board: Core, channel: Channel, command: Command) -> Outcome:
    """M409: the JSON text in one line, which ends in a line break of its own."""
    key = command.string("K", KEY_LENGTH) or ""
    flags = command.string("F", FLAGS_LENGTH) or ""
    channel.status_request = "M409"
    faults = board.faults
    if faults.take("no_reply"):
        return NO_REPLY
    if faults.is_on("few_buffers") and board.firmware.waits_for_buffers:
        return _when_buffers_are_free(board, channel, key, flags)
    return _model_reply(board, channel, key, flags, command.integer("R", 0) == 1)


def _when_buffers_are_free(board: Core, channel: Channel, key: str, flags: str) -> Running:
    """Retry silently below 20 free buffers, as 3.5 and later do."""
    yield lambda: not board.faults.is_on("few_buffers")
    return _model_reply(board, channel, key, flags, False)


def _model_reply(board: Core, channel: Channel, key: str, flags: str, itself: bool) -> Reply:
    board.refresh()
    model: dict[str, Any] = dict(board.data)
    state = model.get("state")
    if isinstance(state, dict) and "thisInput" in state:
        model["state"] = {**state, "thisInput": board.input_index(channel.name)}
    text = None
    if board.faults.is_on("sbc") and not itself:
        text = dsf_reply(model, key, flags)
    if text is None:
        if board.faults.is_on("few_buffers"):
            text = OUT_OF_BUFFERS
        else:
            exponents = board.faults.is_on("exponent")
            text = board.model_text.reply(model, key, flags, exponents=exponents)
            text = board.faults.model_text(text)
    return Reply(text + "\n", Kind.LONG)


def old_status(board: Core, channel: Channel, command: Command) -> Outcome:
    """M408: S0 and S1 for old panels, S2 to S4 as rr_status, S5 as rr_config."""
    kind = command.integer("S", 0) or 0
    if kind == 0:
        channel.status_request = "M408"
    board.refresh()
    text = m408.reply(board, kind)
    # S0 and S1 bring a line break of their own on top (RRF 3.5 RepRap.cpp:1854)
    return Reply(text + ("\n\n" if kind in (0, 1) else "\n"), Kind.LONG)


def resend(board: Core, channel: Channel, command: Command) -> Outcome:
    """M998: asks for a line again; nothing in RRF sends it by itself (RRF 3.5 GCodes2.cpp:4705)."""
    return Reply(f"rs {command.integer('P', 0)}", Kind.TEMPERATURES)


TABLE = {
    "M105": report_temperatures,
    "M114": position,
    "M115": identify,
    "M119": endstops,
    "M122": diagnostics,
    "M220": speed_factor,
    "M221": extrusion_factor,
    "M408": old_status,
    "M409": object_model,
    "M998": resend,
}
