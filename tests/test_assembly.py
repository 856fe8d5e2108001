"""The parts put together without a server: everything that is handed on exists."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from octoprint_rrfmodel.assembly import Assembly
from octoprint_rrfmodel.hooks import hooks_of
from octoprint_rrfmodel.host.notes import NOTES
from octoprint_rrfmodel.rrf.follow.follower import Taken
from tests.support.hosts import host_of

METHODS = ("identified", "replied", "reset", "line", "heard", "forgotten", "tick")


@pytest.fixture
def parts(tmp_path):
    nothing = SimpleNamespace(
        is_operational=lambda: False,
        get_hooks=lambda hook: {},
        get_helpers=lambda *names: None,
    )
    settings = SimpleNamespace(
        get_boolean=lambda path: True,
        get=lambda path, **options: None,
        global_get=lambda path: None,
    )
    return Assembly(host_of(tmp_path, nothing, settings))


def test_every_note_has_who_works_through_it(parts):
    notes = parts.notes()
    assert set(NOTES.values()) <= notes.keys()
    assert all(callable(handler) for handler in notes.values())


def test_every_listener_listens_to_something(parts):
    table = parts.listeners()
    deaf = [each for each in table if not any(hasattr(each, name) for name in METHODS)]
    assert (deaf, len(table)) == ([], len(set(map(id, table))))


def test_the_guard_is_told_before_the_poller_forgets(parts):
    names = [type(each).__name__ for each in parts.listeners()]
    assert names.index("PrintGuard") < names.index("Poller") < names.index("ModelPush")
    assert names[-1] == "Sockets"


def test_a_round_without_a_board_goes_through_every_listener(parts, caplog):
    notes = parts.notes()
    notes["identified"]()
    notes["heard"]("box")
    notes["line"]("ok")
    parts.tell(Taken({"state": True}, False), 0.0)
    parts.tell(Taken({}, True), 0.0)
    notes["disconnected"]()
    assert [record.exc_text for record in caplog.records if record.levelname == "ERROR"] == []
    assert parts.status()["connected"] is False


def test_every_hook_has_its_handler(parts):
    plugin = SimpleNamespace(
        parts=parts,
        before_request=lambda: None,
        body_sizes=lambda current: [],
        update_check=lambda: {},
        routes=lambda server_routes: [],
    )
    handlers = [
        handler[0] if isinstance(handler, tuple) else handler
        for handler in hooks_of(plugin).values()
    ]
    assert all(map(callable, handlers))
