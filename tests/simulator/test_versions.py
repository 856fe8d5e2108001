"""What differs between firmware versions on the wire."""

from __future__ import annotations

import json

import pytest

from octoprint_rrfmodel.simulator.firmware import (
    ALIASES,
    VERSIONS,
    UnknownFirmware,
    firmware_called,
)
from octoprint_rrfmodel.simulator.model.members import MEMBERS, exists

NAMES = list(VERSIONS)
WITH_MODEL = [name for name in NAMES if name != "2.05"]

M115 = {
    "2.05": "FIRMWARE_NAME: RepRapFirmware for Duet 2 WiFi/Ethernet FIRMWARE_VERSION: 2.05.1 "
    "ELECTRONICS: Duet WiFi 1.02 or later FIRMWARE_DATE: 2020-02-09b1",
    "3.3": "FIRMWARE_NAME: RepRapFirmware for Duet 3 Mini 5+ FIRMWARE_VERSION: 3.3 "
    "ELECTRONICS: Duet 3 Mini5plus WiFi FIRMWARE_DATE: 2021-06-15 21:46:11 "
    "FIRMWARE_DATE: 2021-06-15 21:46:11",
    "3.4": "FIRMWARE_NAME: RepRapFirmware for Duet 3 Mini 5+ FIRMWARE_VERSION: 3.4.6 "
    "ELECTRONICS: Duet 3 Mini5plus WiFi FIRMWARE_DATE: 2023-07-21 14:08:28",
    "3.5.1": "FIRMWARE_NAME: RepRapFirmware for Duet 3 Mini 5+ FIRMWARE_VERSION: 3.5.1 "
    "ELECTRONICS: Duet 3 Mini5plus WiFi FIRMWARE_DATE: 2024-04-19 14:30:54",
    "3.5.3": "FIRMWARE_NAME: RepRapFirmware for Duet 3 Mini 5+ FIRMWARE_VERSION: 3.5.3 "
    "ELECTRONICS: Duet 3 Mini5plus WiFi FIRMWARE_DATE: 2024-10-01 14:21:40",
    "3.6": "FIRMWARE_NAME: RepRapFirmware for Duet 3 Mini 5+ FIRMWARE_VERSION: 3.6.0 "
    "ELECTRONICS: Duet 3 Mini5plus WiFi FIRMWARE_DATE: 2025-04-24 11:38:13",
    **{
        version.rpartition(".")[0] if version == "3.7.0" else version: (
            "FIRMWARE_NAME: RepRapFirmware for Duet 3 Mini 5+ FIRMWARE_VERSION: "
            f"{version} ELECTRONICS: Duet 3 Mini5plus WiFi FIRMWARE_DATE: {date}"
        )
        for version, date in (
            ("3.6.1", "2025-09-08 10:00:00"),
            ("3.6.2", "2025-12-08 10:00:00"),
            ("3.6.3", "2026-04-13 10:00:00"),
            ("3.6.4", "2026-07-20 10:00:00"),
            ("3.7.0", "2026-10-05 10:00:00"),
        )
    },
}


@pytest.mark.parametrize("firmware", NAMES)
def test_m115(bench, firmware):
    assert bench(firmware=firmware).send("M115") == M115[firmware] + "\nok\n"


@pytest.mark.parametrize(("alias", "name"), ALIASES.items())
def test_alias(alias, name):
    assert firmware_called(alias) is VERSIONS[name]


def test_unknown_version_names_the_known_ones():
    with pytest.raises(UnknownFirmware, match=r"unknown firmware '4.0', known are 2.05, 3.3"):
        firmware_called("4.0")


@pytest.mark.parametrize("line", ['M409 K"seqs"', "M568 P0 S200", "M486 T0", 'M36.1 P"a.gcode" S0'])
def test_205_knows_none_of_the_newer_commands(bench, line):
    name = line.split()[0]
    expected = f"Warning: {name}: Command is not supported\nok\n"
    assert bench(firmware="2.05").send(line) == expected


def test_205_has_m408_and_g10(bench):
    old = bench(firmware="2.05")
    assert old.send("G10 P0 S200") == "ok\n"
    status = json.loads(old.send("M408 S3")[: -len("\n\nok\n")])
    assert status["temps"]["tools"]["active"] == [[200.0]]
    assert status["firmwareVersion"] == "2.05.1"


def test_205_runs_on_a_duet_2_only(bench):
    assert "Duet 2 WiFi/Ethernet" in bench("corexy", "2.05").send("M115")


@pytest.mark.parametrize("firmware", ["3.3", "3.4", "3.5.3"])
def test_thumbnails_of_m36_came_with_34(bench, firmware):
    reply = bench(firmware=firmware).send('M36 "square.gcode"')
    assert ('"thumbnails"' in reply) is (firmware != "3.3")
    assert ('"firstLayerHeight"' in reply) is (firmware == "3.3")


@pytest.mark.parametrize("firmware", ["3.3", "3.4", "3.5.1", "3.6"])
def test_m38_was_compiled_out_in_35(bench, firmware):
    reply = bench(firmware=firmware).send("M38 square.gcode")
    if firmware in ("3.3", "3.4"):
        assert len(reply) == len("\nok\n") + 40
    else:
        assert reply == "Warning: M38: Command is not supported\nok\n"


SYNTAX = {
    "3.3": "Error: M409: expected a string expression\nok\n",
    "3.4": "Error: M409: expected a string expression\nok\n",
    "3.5.1": "Error:  at column 7: M409: expected a string expression\nok\n",
    "3.5.3": "Error:  at column 7: M409: expected a string expression\nok\n",
    "3.6": "Error:  at column 7: M409: expected a string expression\nok\n",
}


@pytest.mark.parametrize(("firmware", "expected"), SYNTAX.items(), ids=SYNTAX)
def test_syntax_errors(bench, firmware, expected):
    assert bench(firmware=firmware).send("M409 K5") == expected
    too_long = bench(firmware=firmware).send(f'M409 K"{"k" * 101}"')
    assert too_long == expected.replace("expected a string expression", "string too long")


@pytest.mark.parametrize("length", [20, 21])
def test_flags_have_a_limit(bench, length):
    reply = bench().send(f'M409 K"x" F"{"f" * length}"')
    assert reply.startswith("{" if length == 20 else "Error:  at column 12: M409: string too long")


@pytest.mark.parametrize("firmware", WITH_MODEL)
@pytest.mark.parametrize("path", sorted(MEMBERS))
def test_members_are_those_of_the_version(bench, firmware, path):
    """Any member that the table knows is there or isn't, wherever its object is."""
    board = bench("cartesian", firmware).board
    holders = [board.model]
    *parents, name = path.replace("[]", ".[]").split(".")
    for step in parents:
        found = []
        for holder in holders:
            if step == "[]":
                found += [e for e in holder if e is not None] if isinstance(holder, list) else []
            elif isinstance(holder, dict) and isinstance(holder.get(step), (dict, list)):
                found.append(holder[step])
        holders = found
    if not exists(path, board.firmware):
        assert not any(name in holder for holder in holders if isinstance(holder, dict))


@pytest.mark.parametrize("firmware", WITH_MODEL)
def test_members_come_in_the_firmwares_order(bench, firmware):
    def check(value, path):
        if isinstance(value, dict):
            names = list(value)
            if path not in ("global", "limits"):
                assert names == sorted(names), path
            for name, member in value.items():
                check(member, f"{path}.{name}".lstrip("."))
        elif isinstance(value, list):
            for element in value:
                check(element, path + "[]")

    check(bench(firmware=firmware).board.model, "")


LIVE_ROOT = {
    "boards", "fans", "heat", "inputs", "job", "move", "sensors", "seqs", "spindles", "state",
    "tools",
}  # fmt: skip


@pytest.mark.parametrize("firmware", WITH_MODEL)
def test_live_root(bench, firmware):
    found = bench(firmware=firmware).ask("", "d99fn")
    assert set(found) == LIVE_ROOT


@pytest.mark.parametrize("firmware", WITH_MODEL)
def test_keys_of_the_root(bench, firmware):
    keys = set(bench(firmware=firmware).ask("", "vno"))
    assert ("ledStrips" in keys) is firmware.startswith(("3.5", "3.6", "3.7"))
    assert ("scanner" in keys) is firmware.startswith(("3.3", "3.4"))


@pytest.mark.parametrize("firmware", WITH_MODEL)
def test_sequence_numbers(bench, firmware):
    found = bench(firmware=firmware).ask("seqs", "d99vn")
    assert ("ledStrips" in found) is firmware.startswith(("3.5", "3.6", "3.7"))
    assert ("scanner" in found) is firmware.startswith(("3.3", "3.4"))
    assert found["volChanges"] == [0, 0]
    assert found["move"] == 0


@pytest.mark.parametrize("line", ["M408 S0", "M301", "M304"])
def test_37_knows_no_old_commands(bench, line):
    name = line.split()[0]
    assert bench(firmware="3.7").send(line) == f"Warning: {name}: Command is not supported\nok\n"
    assert "not supported" not in bench(firmware="3.6.4").send(line)


def test_37_has_two_channels_over_usb(bench):
    board = bench(firmware="3.7")
    assert [channel["name"] for channel in board.ask("inputs") if channel][-1] == "USB2"
    assert board.ask("state.thisInput", "v") == 3
    board.board.plug_into("USB2")
    assert board.ask("state.thisInput", "v") == 14
    assert board.ask("inputs[14].state") == "executing"
    assert "USB2" not in str(bench(firmware="3.6.4").ask("inputs"))


def test_37_is_for_no_duet_2(bench):
    delta = bench("delta", firmware="3.7")
    assert "Duet 2" not in delta.send("M115")
    assert delta.ask("move.kinematics.name") == "linearDelta"


NAMES_LINE = {"3.6.1": False, "3.6.2": True, "3.6.3": True, "3.7": True}


@pytest.mark.parametrize(("firmware", "names"), NAMES_LINE.items())
def test_json_names_the_line_it_answers(bench, firmware, names):
    board = bench(firmware=firmware)
    first = '"line":12,' if names else ""
    numbered = 'N12 M409 K"state.status"'
    said = board.send(f"{numbered}*{checksum(numbered)}")
    assert said == f'{{{first}"key":"state.status","flags":"","result":"idle"}}\n\nok\n'
    assert board.send('M409 K"state.status"').startswith('{"key"')
    numbered = 'N12 M36 "none"'
    said = board.send(f"{numbered}*{checksum(numbered)}")
    assert said == f'{{{first}"err":1,"fileName":"none"}}\nok\n'


def checksum(line):
    found = 0
    for byte in line.encode():
        found ^= byte
    return found


@pytest.mark.parametrize(("firmware", "at_once"), [("3.6.2", False), ("3.6.3", True)])
def test_an_emergency_stop_goes_past_the_queue(bench, firmware, at_once):
    board = bench(firmware=firmware)
    board.send("T0", "M109 S200")
    board.wait(6)
    board.send("M105", "M112")
    assert board.board.is_halted is at_once
    board.until(lambda b: b.is_halted)


def test_m122_deletes_what_waits_on_usb(bench):
    board = bench(firmware="3.6.3")
    board.send("G4 S2")
    assert board.send('M118 S"lost"', "M122").startswith("=== Diagnostics ===")
    assert board.wait(3) == "ok\n"


@pytest.mark.parametrize("lines", [("M1", "M112"), ("N5 M112",), ("M112x",)])
def test_what_hides_an_emergency_stop(bench, lines):
    board = bench(firmware="3.6.3")
    board.send("G4 S2", *lines)
    assert not board.board.is_halted


def test_m108_ends_a_wait_at_once(bench):
    board = bench(firmware="3.6.3")
    board.send("M140 S60", "M190 S60")
    board.wait(1)
    assert board.send("M108") == "ok\nok\n"
