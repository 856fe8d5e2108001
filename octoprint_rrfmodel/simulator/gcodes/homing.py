"""Homing and probing: G28, G29, G30, G32."""

from __future__ import annotations

from ..clock import Clock
from ..device.card import SYSTEM, Card
from ..device.height_map import DEVIATION, MEAN, grid_of, height_map_text
from ..device.motion import Motion
from ..hardware.blank import NO_TAPER
from ..interpreter.macros import Macros
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome, Running, Silently
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError

HOMING_SECONDS = 2.32
"""Simulated time to home one axis (seen in firmware: 6.96 s for three)."""
AGAIN_SECONDS = 1.44
"""The same for an axis that stands where it was homed to (seen in firmware: 4.32 s for three)."""
PROBE_SECONDS = 1.62
"""Simulated time to probe one point where the head is (seen in firmware)."""
TRAVEL_SECONDS = 1.82
"""Simulated time to a point that G30 P names (seen in firmware)."""
POINT_SECONDS = 2.002
"""Simulated time from one point of a mesh to the next (seen in firmware: 128 s for 64)."""
MESH_POINTS = 64
HEIGHT_MAP = "heightmap.csv"


class Homing:
    """Finds out where the axes are."""

    def __init__(
        self, *, model: ObjectModel, motion: Motion, clock: Clock, macros: Macros, card: Card
    ):
        self._model = model
        self._motion = motion
        self._clock = clock
        self._macros = macros
        self._card = card

    def rows(self) -> Rows:
        return {
            "G28": Row(self._home),
            "G29": Row(self._mesh),
            "G30": Row(self._probe_point),
            "G32": Row(self._true_bed),
        }

    def _home(self, channel: Channel, command: Command) -> Running:
        """G28: homes the axes named, all without any; ok comes at the end."""
        yield self._motion.has_stopped
        axes = self._motion.axes
        indexes = self._motion.named_axes(command.raw) or list(range(len(axes)))
        with self._macros.running(channel):
            needed = [self._seconds_to_home(index) for index in indexes]
            for index in indexes:
                axes[index]["homed"] = False
            self._model.bump("move")
            end = self._clock.now
            for index, seconds in zip(indexes, needed):
                end += seconds
                yield Silently(self._clock.after(end - self._clock.now))
                axis = axes[index]
                axis["homed"] = True
                self._motion.jump({index: self._homed_position(index)})
                self._model.bump("move")

    def _seconds_to_home(self, index: int) -> float:
        axis = self._motion.axes[index]
        is_there = axis["homed"] and axis["machinePosition"] == self._homed_position(index)
        return AGAIN_SECONDS if is_there else HOMING_SECONDS

    def _homed_position(self, index: int) -> float:
        if self._motion.is_delta:
            kinematics = self._model.data["move"]["kinematics"]
            return float(kinematics.get("homedHeight") or 0.0) if index == 2 else 0.0
        endstops = self._model.data["sensors"].get("endstops") or []
        endstop = endstops[index] if index < len(endstops) else None
        axis = self._motion.axes[index]
        return float(axis["max"] if endstop and endstop.get("highEnd") else axis["min"])

    def _mesh(self, channel: Channel, command: Command) -> Outcome:
        """G29: S0 or none probes, S1 loads, S2 clears, S3 saves the height map."""
        mode = command.integer("S", 0)
        compensation = self._model.data["move"]["compensation"]
        if mode == 2:
            compensation.update(file=None, fadeHeight=NO_TAPER, liveGrid=None, meshDeviation=None)
            compensation["type"] = "none"
            self._model.bump("move")
            return None
        path = self._card.path_of(command.string("P") or HEIGHT_MAP, SYSTEM)
        if mode == 1:
            # one that nobody has probed is as if somebody had: a machine in use has one
            if self._card.name_of(path) is None:
                self._save_mesh(path)
            self._load_mesh(path)
            return None
        if mode == 3:
            self._save_mesh(path)
            return f"Height map saved to file {path}"
        return self._probe_mesh(channel)

    def _save_mesh(self, path: str) -> None:
        grid = grid_of(self._model.data["move"]["compensation"].get("probeGrid") or {})
        if grid is not None:
            moment = self._clock.date_time()
            self._card.write(path, height_map_text(grid, moment), moment)

    def _load_mesh(self, path: str) -> None:
        compensation = self._model.data["move"]["compensation"]
        compensation.update(
            file=path,
            type="mesh",
            meshDeviation={"deviation": DEVIATION, "mean": MEAN},
        )
        if "liveGrid" in compensation:
            compensation["liveGrid"] = dict(compensation["probeGrid"])
        self._model.bump("move")

    def _probe_mesh(self, channel: Channel) -> Running:
        if not self._model.data["sensors"].get("probes"):
            raise GCodeError("Z probe number 0 not found")
        if not all(axis["homed"] for axis in self._motion.axes[:3]):
            raise GCodeError("Insufficient axes homed for bed probing")
        yield self._motion.has_stopped
        with self._macros.running(channel):
            yield Silently(self._clock.after(MESH_POINTS * POINT_SECONDS))
        path = self._card.path_of(HEIGHT_MAP, SYSTEM)
        self._save_mesh(path)
        self._load_mesh(path)
        return (
            f"{MESH_POINTS} points probed, min error -0.098, max error 0.104, mean -0.012, "
            f"deviation 0.043\nHeight map saved to file {path}"
        )

    def _probe_point(self, channel: Channel, command: Command) -> Running:
        """G30: probes where the head is."""
        if not self._model.data["sensors"].get("probes"):
            raise GCodeError("Z probe number 0 not found")
        yield self._motion.has_stopped
        is_elsewhere = "P" in command
        with self._macros.running(channel):
            seconds = TRAVEL_SECONDS if is_elsewhere else 0.0
            yield Silently(self._clock.after(seconds + PROBE_SECONDS))
        if is_elsewhere:
            return None
        probe = self._model.data["sensors"]["probes"][0]
        if command.integer("S", 0) == -1:
            return f"Stopped at height {probe['triggerHeight']:.3f} mm"
        index = self._motion.axis_index("Z")
        if index is not None:
            self._motion.axes[index]["homed"] = True
            self._motion.jump({index: float(probe["triggerHeight"])})
            self._model.bump("move")
        return None

    def _true_bed(self, channel: Channel, command: Command) -> Running:
        """G32: runs bed.g."""
        yield self._motion.has_stopped
        with self._macros.running(channel):
            yield from self._macros.system(channel, "bed.g")
