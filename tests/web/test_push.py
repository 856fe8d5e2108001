"""What open pages are pushed of the model, and when."""

from types import SimpleNamespace

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from octoprint_rrfmodel.web.push import GATHERED_SECONDS, SHORTEST_SECONDS, ModelPush


class Rig:
    """A push of a model with two keys; nothing changes unless a test says so."""

    def __init__(self):
        self.told = []
        self.tell = self.told.append
        self.now = 100.0
        self.is_there = True
        self.behind = False
        self.status = {"revision": 1, "ready": True}
        self.push = ModelPush(
            self,
            lambda: {"heat": 1, "move": 2},
            lambda: dict(self.status),
            follower=self,
            clock=lambda: self.now,
        )
        self.pass_time(SHORTEST_SECONDS)
        self.told.clear()

    def are_there(self):
        return self.is_there

    def are_behind(self):
        return False

    def change(self, *keys):
        self.push.replied(SimpleNamespace(changes=dict.fromkeys(keys, True)), self.now)

    def warm(self, *keys):
        self.push.warmed(SimpleNamespace(changes=dict.fromkeys(keys, True)))

    def pass_time(self, seconds):
        self.now += seconds
        self.push.tick()
        return [sorted(message.get("changed", ())) for message in self.told]


def test_a_change_is_told_at_once_behind_a_pause():
    rig = Rig()
    # the state was looked at just now, and had nothing to tell
    assert rig.pass_time(SHORTEST_SECONDS) == []
    rig.change("heat")
    assert rig.pass_time(0.01) == [["heat"]]
    rig.change("heat")
    rig.change("move")
    assert rig.pass_time(SHORTEST_SECONDS / 2) == [["heat"]]
    assert rig.pass_time(SHORTEST_SECONDS / 2) == [["heat"], ["heat", "move"]]


def test_a_key_comes_with_the_reply_that_said_it_has_changed():
    rig = Rig()
    rig.pass_time(SHORTEST_SECONDS)
    rig.behind = True
    rig.change("heat")
    assert rig.pass_time(0.01) == []
    rig.change("move")
    rig.behind = False
    assert rig.pass_time(0.01) == [["heat", "move"]]


def test_temperatures_of_a_line_hold_back_nothing_that_has_changed():
    rig = Rig()
    rig.pass_time(SHORTEST_SECONDS)
    rig.warm("heat")
    assert rig.pass_time(0.1) == []
    rig.change("move")
    assert rig.pass_time(0.01) == [["heat", "move"]]
    rig.warm("heat")
    assert rig.pass_time(SHORTEST_SECONDS - 0.01) == [["heat", "move"]]
    assert rig.pass_time(0.01) == [["heat", "move"], ["heat"]]


def test_a_state_holds_back_nothing_that_has_changed():
    rig = Rig()
    rig.pass_time(SHORTEST_SECONDS)
    rig.status["ready"] = False
    rig.pass_time(SHORTEST_SECONDS)
    assert [message["type"] for message in rig.told] == ["status"]
    rig.change("move")
    assert rig.pass_time(0.01) == [[], ["move"]]


def test_a_key_that_does_not_come_holds_no_change_back():
    rig = Rig()
    rig.pass_time(SHORTEST_SECONDS)
    rig.behind = True
    rig.change("heat")
    assert rig.pass_time(GATHERED_SECONDS - 0.01) == []
    assert rig.pass_time(0.01) == [["heat"]]


def test_what_changed_while_nobody_was_there_is_not_told():
    rig = Rig()
    rig.is_there = False
    rig.change("heat")
    assert rig.pass_time(SHORTEST_SECONDS) == []
    rig.is_there = True
    rig.change("move")
    assert rig.pass_time(SHORTEST_SECONDS) == [["move"]]
