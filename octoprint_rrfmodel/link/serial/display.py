"""OctoPrint told what it can't find out by itself: temperatures, targets, the current tool.

Part of this touches attributes of OctoPrint's connection that have no public form; both versions
have them under the same names.
"""

from octoprint.events import Events

from ...host.version import IS_2

SHOWS_TOOL = IS_2
"""Whether OctoPrint shows a current tool, and wants to be told it like a position."""

KEEP = None
"""In the place of a target: OctoPrint keeps the one that it has."""


class Display:
    """Keeps OctoPrint's own view of the printer right.

    ``link`` is the ``SerialLink``, ``known`` what is known of the machine, ``is_stale()`` says
    whether that is too old to be shown. ``fire(event, payload)`` is OctoPrint's event bus.
    """

    def __init__(self, link, known, is_stale, *, fire):
        self._link = link
        self._known = known
        self._is_stale = is_stale
        self._fire = fire

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Show the current tool, unless it was asked for before OctoPrint last selected one."""
        tool = self._known.model().get("state", {}).get("currentTool")
        if isinstance(tool, int) and self._known.asked_at > self._link.tool_command_at:
            self.follow_tool(tool)

    ##~~ octoprint.comm.protocol.temperatures.received

    def on_temperatures(self, comm, parsed, *args, **kwargs):
        """Return the report with the model's tools, bed, chamber and sensors in it."""
        if comm is not self._link.connection:
            return parsed
        known, knows_targets = self._known.heat()
        if known is None:
            return parsed
        is_fresh = not self._is_stale()
        # a report has T for the current tool, and OctoPrint takes that for T0 where there is
        # none: only the model knows the numbers
        merged = {name: value for name, value in parsed.items() if not name.startswith("T")}
        current = comm.getCurrentTool()
        highest = max([current, *(int(n[1:]) for n in parsed if n[0] == "T" and n[1:].isdigit())])
        # OctoPrint takes a tool for a sensor if its number is higher than any in the report, and
        # takes them all for sensors if neither the current one nor T0 is there
        is_readable = current in known.tools or 0 in known.tools
        # what the line has just told is newer than any model; a T alone may be any tool's
        tells_all = all(f"T{number}" in parsed for number in known.tools)
        for number, value in known.tools.items():
            told = parsed.get(f"T{number}") if tells_all or not is_fresh else None
            actual, target = told or (value if is_fresh else (None, None))
            if is_fresh and not told and not knows_targets:
                target = KEEP
            if is_readable and number <= highest:
                merged[f"T{number}"] = (actual, target)
            else:
                comm.last_temperature.set_tool(number, actual=actual, target=target)
        if is_fresh:
            slots = {"B": known.bed, "C": known.chamber}
            for name, value in slots.items():
                if value and name not in parsed:
                    merged[name] = value if knows_targets else (value[0], KEEP)
            merged.update(known.others)
        return merged

    def is_shown(self):
        """Return whether OctoPrint shows each heater and sensor that is known, and its target."""
        known, knows_targets = self._known.heat()
        if known is None or not knows_targets:
            return False
        shown = self._link.connection.last_temperature
        heaters = [(shown.tools.get(number), value) for number, value in known.tools.items()]
        slots = {"bed": known.bed, "chamber": known.chamber}
        heaters += [(getattr(shown, name), value) for name, value in slots.items() if value]
        shows_others = not known.others or known.others.keys() <= shown.custom.keys()
        return shows_others and all(_agree(*heater) for heater in heaters)

    ##~~ what happens without OctoPrint's knowing

    def show_target(self, heater, target):
        """Show the target of ``tool<n>``, ``bed`` or ``chamber`` that a command is about to set."""
        comm = self._link.connection
        if comm is None:
            return
        known = comm.last_temperature
        if heater == "bed":
            known.set_bed(target=target)
        elif heater == "chamber":
            known.set_chamber(target=target)
        else:
            known.set_tool(int(heater[len("tool") :]), target=target)
        comm._callback.on_comm_temperature_update(
            known.tools, known.bed, known.chamber, known.custom
        )

    def follow_tool(self, number):
        """Show the current tool where a macro or another panel changed it; there is no "none"."""
        comm = self._link.connection
        if comm is None or number < 0:
            return
        old = comm.getCurrentTool()
        if old == number or comm._toolBeforeHeatup is not None:
            return
        comm._toolBeforeChange = old
        comm._currentTool = number
        self._fire(Events.TOOL_CHANGE, {"old": old, "new": number})
        if SHOWS_TOOL:
            comm._callback.on_comm_position_update({"t": number})


def _agree(shown, known):
    """Return whether a heater is shown, with the target that is known."""
    return bool(shown) and shown[0] is not None and (shown[1] or 0) == (known[1] or 0)
