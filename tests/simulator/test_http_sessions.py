"""Sessions, keys, replies and the G-code input of a board over HTTP (rrf-network.md 2 and 3)."""

from __future__ import annotations

import pytest

from octoprint_rrfmodel.simulator.firmware import VERSIONS
from tests.simulator.http_bench import http_bench
from tests.support.waiting import wait_for


@pytest.fixture
def bench():
    with http_bench() as bench:
        yield bench


def count(bench):
    with bench.board.lock:
        return len(bench.face.sessions)


LOGINS = {
    "2.05": '{"err":0,"sessionTimeout":8000,"boardType":"duetwifi102"}',
    "3.3": '{"err":0,"sessionTimeout":8000,"boardType":"duet5lcwifi","apiLevel":1}',
    "3.4": '{"err":0,"sessionTimeout":8000,"boardType":"duet5lcwifi","apiLevel":1}',
}
NEWER = '{"err":0,"sessionTimeout":8000,"boardType":"duet5lcwifi","apiLevel":2,"sessionKey":0}'


@pytest.mark.parametrize("firmware", VERSIONS)
def test_a_login_of_each_version(firmware):
    with http_bench("cartesian", firmware) as bench:
        body = bench.get("connect", password="").body.decode()
        model = bench.get("model", key="state.status")
        status = bench.get("status", type=1)
    if firmware == "2.05":
        body = body.replace("duet5lcwifi", "duetwifi102")
    assert body == LOGINS.get(firmware, NEWER)
    assert model.status == (500 if firmware == "2.05" else 200)
    assert status.status == (500 if firmware == "3.7" else 200)


def test_a_session_lives_for_eight_seconds_after_its_last_use(bench):
    bench.log_in()
    for _ in range(3):
        bench.wait(7)
        assert bench.get("model", key="state.status").status == 200
    bench.wait(8)
    assert bench.get("model", key="state.status").status == 401


def test_stale_keys_fill_the_table_and_lock_everybody_out(bench):
    bench.log_in()
    with bench.board.lock:
        bench.face.sessions.forget()
    for taken in range(1, 9):
        assert bench.get("model", key="state.status").status == 401
        assert count(bench) == taken
    assert bench.get(
        "connect", password="", sessionKey="yes", session="", source="127.0.0.2"
    ).json == {"err": 2}
    bench.wait(8)
    assert bench.log_in()["err"] == 0


def test_with_a_password_stale_keys_take_nothing(bench):
    bench.board.execute('M551 P"secret"')
    bench.key = 12345
    for _ in range(9):
        assert bench.get("model", key="state.status").status == 401
    assert count(bench) == 0
    assert bench.log_in("secret")["err"] == 0


def test_reprap_is_no_password(bench):
    bench.board.execute('M551 P"reprap"')
    assert bench.log_in("whatever")["err"] == 0


def test_the_first_login_sets_the_clock(bench):
    bench.log_in(time="2026-1-5T9:5:3")
    bench.wait(10)
    assert bench.log_in(time="2030-01-01T00:00:00")["err"] == 0
    assert bench.ask("state.time") == "2026-01-05T09:05:13"


def test_each_command_has_its_reply_and_is_counted(bench):
    bench.log_in()
    before = bench.ask("seqs.reply")
    assert bench.get("gcode", gcode="G92 X1").json == {"buff": 248}
    bench.get("gcode", gcode='M118 P0 S"to all"')
    assert bench.ask("seqs.reply") == before + 3
    assert bench.get("reply").body == b"\nto all\n\n"
    assert bench.get("reply").body == b""
    assert bench.ask("seqs.reply") == before + 3


def test_what_only_usb_hears_is_no_reply(bench):
    bench.log_in()
    bench.board.receive(b'M118 P1 S"usb"\nM118 P3 S"network"\nM115\n')
    assert bench.get("reply").body == b"network\n"


def test_without_a_session_nothing_is_kept_or_counted(bench):
    bench.board.receive(b'M118 S"nobody"\n')
    bench.log_in()
    assert bench.ask("seqs.reply") == 0
    assert bench.get("reply").body == b""


def test_a_reply_is_shared_by_counting_fetches(bench):
    """Two fetches of one client take the other's; what comes in between is told twice."""
    first = bench.log_in()["sessionKey"]
    second = bench.log_in()["sessionKey"]
    bench.board.receive(b'M118 S"three"\n')
    assert bench.get("reply", session=first).body == b"three\n"
    bench.board.receive(b'M118 S"four"\n')
    assert bench.get("reply", session=second).body == b"three\nfour\n"
    assert bench.get("reply", session=first).body == b"three\nfour\n"
    assert bench.get("reply", session=second).body == b""
    bench.board.receive(b'M118 S"five"\n')
    assert [bench.get("reply", session=first).body for _ in range(2)] == [b"five\n", b"five\n"]
    assert bench.get("reply", session=second).body == b""


def test_one_who_never_fetches_pins_replies_for_eight_seconds(bench):
    bench.log_in()
    bench.get("model", source="127.0.0.2", session=0)
    bench.board.receive(b'M118 S"x"\n')
    assert bench.get("reply").body == b"x\n"
    for _ in range(2):
        assert bench.get("reply").body == b"" or bench.time < 8
        bench.wait(4)
        bench.get("model", source="127.0.0.2", session=0)
        bench.get("model")
    assert bench.get("reply").body == b""


def test_pinned_buffers_leave_no_room_for_a_model(bench):
    bench.log_in()
    bench.board.receive(b"".join(b'M118 S"%s"\n' % (b"x" * 200) for _ in range(26)))
    assert bench.get("model", key="state.status").status == 503
    assert len(bench.get("reply").body) > 4000
    assert bench.get("model", key="state.status").status == 200


def test_the_input_has_255_bytes(bench):
    bench.log_in()
    bench.get("gcode", gcode="G4 S10")
    assert bench.get("gcode", gcode='M118 S"a"\nM118 S"b"').json == {"buff": 235}
    assert bench.get("gcode", gcode="x" * 235).json == {"err": 1}
    assert bench.get("gcode").json == {"buff": 235}
    bench.get("reply")
    bench.wait(11)
    assert bench.log_in()["err"] == 0
    assert bench.get("gcode").json == {"buff": 255}


def test_before_345_what_does_not_fit_is_lost_without_a_word():
    with http_bench("cartesian", "3.3") as bench:
        bench.get("gcode", gcode="G4 S10")
        assert bench.get("gcode", gcode="x" * 255).json == {"buff": 255}
        assert bench.get("gcode", gcode="y" * 100).json == {"buff": 154}
        assert bench.get("gcode", gcode="x" * 200).json == {"buff": 154}


STOPS = {
    "M112": True,
    "m112;now": True,
    "\nM112": True,
    "M112\nM115": True,
    "N1 M112": False,
    "M1120": False,
}


@pytest.mark.parametrize(("text", "stops"), STOPS.items(), ids=map(repr, STOPS))
def test_an_emergency_stop_passes_what_runs(bench, text, stops):
    bench.log_in()
    bench.get("gcode", gcode="G4 S100")
    counted = bench.ask("seqs.reply")
    bench.get("gcode", gcode=text)
    status = bench.ask("state.status")
    assert (status == "halted") == stops
    if text == "M112":
        assert bench.ask("seqs.reply") == counted


def test_behind_an_m1_a_stop_waits_once(bench):
    bench.log_in()
    bench.get("gcode", gcode="G4 S100")
    bench.get("gcode", gcode="M1")
    bench.get("gcode", gcode="M112")
    assert bench.ask("state.status") != "halted"
    bench.get("gcode", gcode="M112")
    assert bench.ask("state.status") == "halted"


def test_a_bare_m122_empties_the_input(bench):
    bench.log_in()
    bench.get("gcode", gcode="G4 S5")
    bench.get("gcode", gcode='M118 S"lost"')
    assert bench.get("gcode", gcode="M122").json == {"buff": 255}
    bench.wait(6)
    text = bench.get("reply").body.decode()
    assert "=== Diagnostics ===" in text
    assert "lost" not in text


def test_polls_go_on_while_a_command_runs(bench):
    bench.log_in()
    bench.get("gcode", gcode="M190 S100")
    for _ in range(3):
        bench.wait(1)
        assert bench.ask("inputs[0].state") == "waiting"


def test_a_restart_ends_sessions_and_counters_and_takes_its_time(bench):
    bench.log_in()
    bench.get("gcode", gcode='M118 S"x"')
    bench.get("gcode", gcode="M999")
    assert bench.ask("seqs.reply") > 0
    bench.wait(1.5)
    assert bench.is_refused()
    bench.wait(5)
    wait_for(lambda: not bench.is_refused(), what="the board to be back")
    answer = bench.get("model", key="state.status")
    assert answer.status == 401
    bench.key = None
    assert bench.ask("seqs.reply") == 0
    assert bench.ask("state.upTime") == 5


def test_both_links_have_the_same_board(bench):
    bench.log_in()
    bench.board.receive(b"M104 S50\n")
    assert bench.ask("heat.heaters[1].active") == 50
    bench.get("gcode", gcode="M104 S60")
    bench.board.receive(b'M409 K"heat.heaters[1].active"\n')
    assert b'"result":60' in bench.board.transmit()


def test_a_session_that_uploads_is_not_given_back(bench):
    key = bench.log_in()["sessionKey"]
    with bench.board.lock:
        bench.face.sessions.find("127.0.0.1", key).uploads = 1
    assert bench.get("disconnect").json == {"err": 1}
    with bench.board.lock:
        bench.face.sessions.find("127.0.0.1", key).uploads = 0
    assert bench.get("disconnect").json == {"err": 0}
    assert bench.get("disconnect").status == 401
