"""Faults of the network: switched on, seen by a client, switched off."""

from __future__ import annotations

import json
import threading
import time
from pathlib import Path

import pytest

from octoprint_rrfmodel.simulator.faults import FAULTS
from tests.simulator.http_bench import http_bench
from tests.support.waiting import wait_for


@pytest.fixture
def bench():
    with http_bench() as bench:
        bench.log_in()
        yield bench


def poll(bench):
    return bench.get("model", key="state.status")


def is_well(bench):
    said = poll(bench)
    return said.status == 200 and not said.is_reset and is_json(said.body)


def is_reset_in_the_middle(said):
    return said.status == 200 and said.is_reset


ONCE = {
    "net_reset": is_reset_in_the_middle,
    "net_cut": lambda said: said.status == 200 and 0 < len(said.body) < 50,
    "net_lost_answer": lambda said: said.is_reset and not said.data,
    "net_503:1": lambda said: said.data == b"HTTP/1.1 503 Service Unavailable\r\n\r\n",
    "net_foreign:1": lambda said: said.status == 200 and b"hotel" in said.body,
    "net_redirect:1": lambda said: said.status == 302 and "192.0.2.1" in said.head,
    "net_garbled": lambda said: said.status == 200 and not is_json(said.body),
    "err_no_buffers:1": lambda said: said.status == 503,
}


def is_json(data):
    try:
        return bool(json.loads(data))
    except ValueError:
        return False


@pytest.mark.parametrize(("fault", "shows"), ONCE.items(), ids=ONCE)
def test_it_strikes_once(bench, fault, shows):
    bench.board.inject(fault)
    assert shows(poll(bench))
    assert is_well(bench)


@pytest.mark.parametrize("fault", ["net_503", "net_foreign", "net_redirect"])
def test_it_strikes_until_it_is_cleared(bench, fault):
    bench.board.inject(fault)
    assert not any(is_well(bench) for _ in range(3))
    bench.board.clear(fault)
    assert is_well(bench)


def test_a_command_whose_answer_is_lost_is_carried_out(bench):
    bench.board.inject("net_lost_answer")
    assert not bench.get("gcode", gcode="M104 S50").data
    assert bench.ask("heat.heaters[1].active") == 50


def test_of_commands_alone_the_answer_is_lost_whatever_is_asked_before(bench):
    bench.board.inject("net_lost_command")
    assert is_well(bench)
    assert not bench.get("gcode", gcode="M104 S50").data
    assert bench.ask("heat.heaters[1].active") == 50
    assert bench.get("gcode", gcode="M104 S60").status == 200


def test_a_command_that_is_refused_by_503_is_not(bench):
    bench.board.inject("net_503:1")
    bench.get("gcode", gcode="M104 S50")
    assert bench.ask("heat.heaters[1].active") == 0


def test_a_changed_byte_is_found_by_the_checksum_alone(bench):
    bench.board.inject("net_corrupt:2")
    assert bench.post(b"G28\n", name="0:/gcodes/a.g").json == {"err": 0}
    assert bench.get("download", name="0:/gcodes/a.g").body != b"G28\n"
    assert bench.post(b"G28\n", name="0:/gcodes/a.g", crc32="f9eaa09a").json == {"err": 1}


def test_slow_answers(bench):
    bench.board.inject("net_slow:0.2")
    started = time.monotonic()
    assert is_well(bench)
    assert time.monotonic() - started >= 0.2


def test_all_sessions_taken(bench):
    bench.board.inject("net_full")
    assert is_well(bench)
    assert bench.get("connect", password="", session=0).json == {"err": 2}
    assert bench.get("model", session=0).status == 401


def test_a_key_that_is_stale(bench):
    bench.board.inject("net_stale_key")
    assert poll(bench).status == 401
    assert bench.log_in()["err"] == 0


def test_refused_connections_for_a_time(bench):
    bench.board.inject("net_refused:10")
    wait_for(bench.is_refused, what="a refusal")
    bench.wait(11)
    wait_for(lambda: not bench.is_refused(), what="the board to be back")
    assert poll(bench).status == 401


def test_what_is_sent_while_the_network_is_down_never_arrives(bench):
    bench.board.inject("net_loss:60")
    said = []
    command = threading.Thread(target=lambda: said.append(bench.get("gcode", gcode="M104 S50")))
    command.start()
    command.join(0.2)
    assert command.is_alive()
    bench.wait(61)
    command.join(20)
    assert (said[0].data, said[0].is_reset) == (b"", True)
    bench.log_in()
    assert bench.ask("heat.heaters[1].active") == 0


def test_no_free_responder(bench):
    bench.board.inject("net_busy")
    said = poll(bench)
    assert (said.data, said.is_reset) == (b"", True)


def test_few_buffers_are_503_for_a_model_and_for_a_list(bench):
    bench.board.inject("few_buffers")
    assert poll(bench).status == 503
    assert bench.get("filelist", dir="0:/gcodes").status == 503
    assert bench.get("gcode").json == {"buff": 255}


def test_every_fault_of_the_network_is_tried_here():
    source = Path(__file__).read_text(encoding="utf-8")
    others = {"net_sbc_down", "net_sbc_version"}
    tried = {name for name in FAULTS if name.startswith("net_") and f'"{name}' in source}
    assert {name for name in FAULTS if name.startswith("net_")} == tried | others


def test_every_fault_of_the_network_is_in_the_docs():
    text = (Path(__file__).resolve().parents[2] / "docs" / "simulator.md").read_text(
        encoding="utf-8"
    )
    rows = {row.split("`")[1] for row in text.splitlines() if row.startswith("| `net_")}
    assert rows == {name for name in FAULTS if name.startswith("net_")}
