"""OctoPrint's printer operations on a board of the network, by the table that serial lines have.

OctoPrint calls them on threads of requests and checks little: what the machine can't do is refused
here, with a notification, and nothing waits for the board.
"""

from octoprint.events import eventManager
from octoprint.printer import UnknownScript
from octoprint.settings import settings

from ...rrf.gcode import operations
from ...rrf.gcode.operations import Refused

SLOTS = ("bed", "chamber")

PRINTS = Refused("prints")


class Operations:
    """The part of the printer that moves, heats and says G-code."""

    def commands(self, *commands, tags=None, force=False, **kwargs):
        self.network.link.send([str(each) for each in commands], tags or ())

    def script(
        self,
        name,
        context=None,
        tags=None,
        must_be_set=True,
        part_of_job=False,
        *args,
        **kwargs,
    ):
        event = f"GcodeScript{name[0].upper()}{name[1:]}"
        payload = context.get("event") if isinstance(context, dict) else None
        eventManager().fire(f"{event}Running", payload)
        told = {"printer_profile": self.profile, "script": {"name": name}, **(context or {})}
        text = settings().loadScript("gcode", name, context=told)
        if text is None and must_be_set:
            raise UnknownScript(name)
        lines = [line.partition(";")[0] for line in (text or "").splitlines()]
        self.network.link.send(lines, tags or ())
        eventManager().fire(f"{event}Finished", payload)

    def jog(self, axes, relative=True, speed=None, tags=None, *args, **kwargs):
        moves = {axis.upper(): amount for axis, amount in axes.items()}
        if speed is None:
            speed = min((self._profile_speed(axis) for axis in axes), default=None)
        self._operate(tags, operations.jog, moves, relative, speed or None, between_prints=True)

    def home(self, axes, tags=None, *args, **kwargs):
        letters = [axes] if isinstance(axes, str) else axes
        self._operate(
            tags, operations.home, [letter.upper() for letter in letters], between_prints=True
        )

    def extrude(self, amount, speed=None, tags=None, *args, **kwargs):
        rate = self._profile_speed("e") if speed is None else speed
        self._operate(tags, operations.extrude, amount, rate or None, between_prints=True)

    def change_tool(self, tool, tags=None, *args, **kwargs):
        self._operate(tags, operations.select, int(tool[len("tool") :]), between_prints=True)

    def set_temperature(self, heater, value, tags=None, *args, **kwargs):
        if heater in SLOTS:
            self._operate(tags, operations.heat_slot, heater, value)
        else:
            number = heater[len("tool") :]
            self._operate(tags, operations.heat_tool, int(number) if number else None, value)

    def feed_rate(self, factor, tags=None, *args, **kwargs):
        self._operate(tags, operations.speed_factor, factor)

    def flow_rate(self, factor, tags=None, *args, **kwargs):
        self._operate(tags, operations.extrusion_factor, factor)

    def _operate(self, tags, operation, *arguments, between_prints=False):
        """Send an operation's lines, or tell why not."""
        machine = self.network.machine()
        is_refused = between_prints and machine.prints
        outcome = PRINTS if is_refused else operation(machine, *arguments)
        if isinstance(outcome, Refused):
            self.network.notify("refused_operation", outcome.code, outcome.detail)
        else:
            self.network.link.send(outcome.lines, tags or ())

    def _profile_speed(self, axis):
        """Return the speed of an axis in the printer profile, in mm/min."""
        axes = (self.profile or {}).get("axes", {})
        return axes.get(axis, {}).get("speed") or 1000
