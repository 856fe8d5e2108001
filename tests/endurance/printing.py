"""A print that OctoPrint streams, and what of it has come to the board."""

from .scene import Harmed

SECONDS = 150

LINE_KINDS = (
    lambda rig, number: f"G4 P{number % 7 + 1}",
    lambda rig, number: f"M117 line {number}",
    lambda rig, number: f"M106 P0 S{number % 100 / 100:.2f}",
    lambda rig, number: 'M98 P"0:/macros/Say hello"',
    lambda rig, number: f"M220 S{90 + number % 20}",
    lambda rig, number: f"M290 S0.0{number % 9 + 1}",
    lambda rig, number: f"T{rig.random.choice(rig.tools())}" if rig.tools() else "T0",
    lambda rig, number: f"M109 S{40 + number % 5}",
    lambda rig, number: "G28",
)
"""What stands among the moves."""

EVERY = 60
"""Moves between two lines of those kinds, on average."""


def moves(count):
    """Return so many lines, each another one; each takes the board most of a second."""
    return [
        f"G1 X{20 + number % 2 * 15}.{number % 100:02d} Y{20 + number // 100:d} F1500"
        for number in range(count)
    ]


class Streamed:
    """A file of ``count`` moves with other lines among them, uploaded and printed."""

    def __init__(self, rig, count, extra=(), *, kinds=LINE_KINDS):
        self.rig = rig
        self.lines = []
        for number, move in enumerate(moves(count)):
            if kinds and number and rig.random.random() < 1 / EVERY:
                self.lines.append(rig.random.choice(kinds)(rig, number))
            self.lines.append(move)
        for place, line in extra:
            self.lines.insert(int(len(self.lines) * place), line)
        self._wanted = set(self.lines)
        self.name = f"week {rig.turn % 5}.gcode".replace(" ", "-")
        self._since = 0

    def start(self):
        """Return when OctoPrint prints it."""
        rig = self.rig
        rig.home()
        rig.server.upload(self.name, "\n".join(self.lines) + "\n")
        self._since = rig.received()
        rig.server.select_and_print(self.name)
        rig.wait(lambda: self.arrived(), 30, "the first line of the print")
        return self

    def arrived(self):
        """Return the lines of the file that have come to the board, in order."""
        return [line for line in self.rig.commands(self._since) if line in self._wanted]

    def wait_part(self, part):
        """Return when that part of the lines has come."""
        count = int(len(self.lines) * part)
        self.rig.wait(lambda: len(self.arrived()) >= count, SECONDS, f"line {count} of the print")

    def wait_done(self):
        """Return when OctoPrint has said that it is done, and the board has had it all."""
        rig = self.rig
        rig.wait(
            lambda: any(rig.events(name) for name in ("PrintDone", "PrintFailed", "Error")),
            SECONDS,
            "the end of the print",
        )
        rig.server.wait_state("Operational")
        rig.wait(
            lambda: len(self.arrived()) >= len(self.lines), 30, "the last line of the print to come"
        )
        self.assert_complete()
        rig.lines += len(self.lines)

    def assert_complete(self):
        """Each line has come once, in order, and none other between."""
        came = self.arrived()
        if came != self.lines:
            raise Harmed(f"the print's lines are others than the file's: {_difference(came, self)}")

    def assert_beginning(self):
        """What has come is the beginning of the file, each line once, in order."""
        came = self.arrived()
        if came != self.lines[: len(came)]:
            raise Harmed(f"the print's lines aren't the file's first: {_difference(came, self)}")
        self.rig.lines += len(came)

    def assert_in_order(self):
        """No line has come twice or too early, though some may be lost with the board."""
        ahead = iter(self.lines)
        for number, line in enumerate(self.arrived()):
            if line not in ahead:
                raise Harmed(f"line {number} of the print, {line!r}, came twice or too late")
        self.rig.lines += len(self.arrived())


def _difference(came, print_):
    lines = print_.lines
    place = next(
        (place for place, (one, other) in enumerate(zip(came, lines)) if one != other),
        min(len(came), len(lines)),
    )
    return (
        f"from {place} on {came[place : place + 4]} for {lines[place : place + 4]}; "
        f"{len(came)} came of {len(lines)}"
    )
