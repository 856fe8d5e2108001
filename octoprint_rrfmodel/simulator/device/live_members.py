"""The members of the model that follow from everything else: status, clocks, inputs."""

from __future__ import annotations

import datetime
from typing import TYPE_CHECKING

from ..model.build import BOOT_TIME
from . import job as jobs

if TYPE_CHECKING:
    from ..core import Core

_BOOT = datetime.datetime.fromisoformat(BOOT_TIME)

_JOB_STATUS = {
    jobs.PAUSING: "pausing",
    jobs.RESUMING: "resuming",
    jobs.PAUSED: "paused",
    jobs.CANCELLING: "cancelling",
    jobs.PRINTING: "processing",
}


def shown_status(board: Core) -> str:
    """Return ``state.status``; the order of precedence is RRF 3.5 RepRap.cpp:2391."""
    if board.is_halted:
        return "halted"
    if not board.has_power:
        return "off"
    status = _JOB_STATUS.get(board.job.state or "")
    if status == "processing" and board.job.is_simulation:
        return "simulating"
    if status is not None and (status != "cancelling" or board.firmware.has_cancelling):
        return status
    if board.is_changing_tool:
        return "changingTool"
    if board.macros_running or board.motion.is_moving or board.boxes.is_blocking:
        return "busy"
    return "idle"


def date_time(board: Core) -> str:
    """Return the board's wall clock as the model shows it."""
    moment = _BOOT + datetime.timedelta(seconds=int(board.up_time))
    return moment.isoformat()


def show(board: Core) -> None:
    """Bring positions, status, clocks and inputs of the model up to date."""
    board.motion.show(board.now)
    board.job.show()
    state = board.data["state"]
    up_time = board.up_time
    state["status"] = shown_status(board)
    state["upTime"] = int(up_time)
    if "msUpTime" in state:
        state["msUpTime"] = int(up_time * 1000) % 1000
    state["time"] = date_time(board)
    for gcode_input in board.data.get("inputs") or ():
        if gcode_input is None:
            continue
        channel = board.channels.get(gcode_input["name"])
        if channel is not None:
            gcode_input["state"] = channel.state
            if "inMacro" in gcode_input:
                gcode_input["inMacro"] = channel.is_in_macro
