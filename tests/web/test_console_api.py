"""What pages are pushed of what was said: each line once, and never more than there is room for."""

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from octoprint_rrfmodel.web.console_api import MOST_PUSHED, Console


class Rig:
    """A console over a list of lines."""

    def __init__(self):
        self.lines = []
        self.told = []
        self.tell = self.told.append
        self.now = 0.0
        self.is_behind = False
        self.is_there = True
        self.console = Console(self, self, lambda: self.now)

    def since(self, number):
        return [line for line in self.lines if line["number"] > number]

    @property
    def newest(self):
        return len(self.lines)

    def are_behind(self):
        return self.is_behind

    def are_there(self):
        return self.is_there

    def say(self, count):
        last = len(self.lines)
        self.lines += [{"number": last + n + 1} for n in range(count)]

    def tick(self):
        self.now += 1.0
        self.console.tick()
        told, self.told[:] = list(self.told), []
        return [(len(message["lines"]), message["missed"]) for message in told]


def test_each_line_is_told_once():
    rig = Rig()
    assert rig.tick() == []
    rig.say(3)
    assert rig.tick() == [(3, 0)]
    assert rig.tick() == []


def test_what_has_no_room_is_counted():
    rig = Rig()
    rig.say(MOST_PUSHED + 7)
    assert rig.tick() == [(MOST_PUSHED, 7)]
    assert rig.tick() == []


def test_pages_that_are_behind_get_it_later():
    rig = Rig()
    rig.say(2)
    rig.is_behind = True
    assert rig.tick() == []
    rig.is_behind = False
    assert rig.tick() == [(2, 0)]


def test_what_was_said_before_anybody_was_there_is_read_and_not_told():
    rig = Rig()
    rig.say(2)
    rig.is_there = False
    assert rig.tick() == []
    rig.is_there = True
    assert rig.tick() == []
    rig.say(1)
    assert rig.tick() == [(1, 0)]
