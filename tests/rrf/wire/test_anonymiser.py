"""Whatever a person has put into a machine doesn't come out, and the rest does."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.m409 import answer
from octoprint_rrfmodel.rrf.wire.anonymiser import UNREADABLE, Anonymiser
from octoprint_rrfmodel.rrf.wire.pseudonyms import Pseudonyms
from octoprint_rrfmodel.simulator.board import Board
from tests.rrf.strategies import ANY_JSON

MODEL = json.loads(json.dumps(Board("toolchanger", "3.6").model).replace("NaN", "null"))

LETTERS = "abcdefghijklmnopqrstuvwxyz"

OWN = st.one_of(
    st.text(LETTERS, min_size=1, max_size=8).map(lambda text: f"Zq{text}Kx"),
    st.ip_addresses().map(str),
    st.text("0123456789ABCDEF", min_size=12, max_size=12).map(
        lambda text: ":".join(text[at : at + 2] for at in range(0, 12, 2))
    ),
    st.text(LETTERS, min_size=1, max_size=8).map(lambda text: f"Zq {text} Kx.gcode"),
    st.from_regex(r"\+[0-9]{9,12}", fullmatch=True),
).filter(lambda text: len(text) > 5)
"""What may be somebody's own: names, addresses, names of files, numbers of telephones."""

PLACES = [
    ("boards", 0, "uniqueId"),
    ("fans", 0, "name"),
    ("global", "material"),
    ("job", "file", "fileName"),
    ("job", "file", "generatedBy"),
    ("job", "lastFileName"),
    ("move", "compensation", "file"),
    ("move", "extruders", 0, "filament"),
    ("network", "hostname"),
    ("network", "name"),
    ("network", "corsSite"),
    ("network", "interfaces", 0, "ssid"),
    ("network", "interfaces", 0, "actualIP"),
    ("network", "interfaces", 0, "mac"),
    ("sensors", "analog", 0, "name"),
    ("state", "displayMessage"),
    ("state", "logFile"),
    ("state", "startupError"),
    ("state", "powerFailScript"),
    ("tools", 1, "name"),
    ("volumes", 0, "name"),
    ("volumes", 0, "path"),
    ("somethingNew",),
    ("tools", 1, "somethingNew"),
]
"""Where a person's own texts are in a model, and where nobody knows yet."""


def put(model, place, value):
    whole = json.loads(json.dumps(model))
    part = whole
    for step in place[:-1]:
        part = part[step]
    part[place[-1]] = value
    return whole


def shape(value):
    """Return a value's structure: what it is of, without names and texts."""
    if isinstance(value, dict):
        return [shape(below) for below in value.values()]
    if isinstance(value, list):
        return ["list", *map(shape, value)]
    return type(value)


def told(value):
    return json.dumps(value, ensure_ascii=False)


@given(st.sampled_from(PLACES), OWN, st.sampled_from(["{}", "0:/gcodes/{}", "x {} y"]))
def test_no_text_of_a_person_s_comes_out_of_a_model(place, text, form):
    model = put(MODEL, place, form.format(text))
    shown = Anonymiser().model(model)
    assert text not in told(shown)
    assert shape(shown) == shape(model)


@given(st.dictionaries(OWN, OWN | st.integers(1000) | st.floats(1000, 1e9), min_size=1), st.data())
def test_nothing_of_what_people_have_named_comes_out(variables, data):
    place = data.draw(st.sampled_from([("global",), ("plugins",), ("job", "file", "customInfo")]))
    model = put(MODEL, place, variables)
    shown = Anonymiser().model(model)
    part = shown
    for step in place:
        part = part[step]
    for name, value in variables.items():
        assert name not in told(shown) and value not in part.values()
    assert [type(value) for value in part.values()] == list(map(type, variables.values()))


def test_what_is_the_firmware_s_stays():
    assert answer(Anonymiser().model(MODEL), "move", "d99vno") == answer(MODEL, "move", "d99vno")
    shown = Anonymiser().model(MODEL)
    for key in ("heat", "limits", "seqs", "spindles", "directories", "inputs"):
        assert shown[key] == MODEL[key]
    assert shown["state"] == MODEL["state"]
    assert shown["boards"][0]["firmwareName"] == MODEL["boards"][0]["firmwareName"]


@given(ANY_JSON)
def test_whatever_comes_keeps_its_structure(value):
    assert shape(Anonymiser().members(value)) == shape(value)
    assert shape(Anonymiser().model(value, "tools[]")) == shape(value)


@given(st.lists(st.sampled_from(["Vera", "vase.gcode", "Bett 2", "192.0.2.7"]), max_size=12))
def test_equal_stays_equal_and_nothing_else(texts):
    anonymiser = Anonymiser()
    shown = [anonymiser.model(text, f"tools[{place}].name") for place, text in enumerate(texts)]
    pairs = set(zip(texts, shown))
    assert len(pairs) == len({text for text, _ in pairs}) == len({name for _, name in pairs})


def test_a_file_is_the_same_in_the_model_in_a_command_and_in_a_reply():
    anonymiser = Anonymiser()
    file = anonymiser.model("0:/gcodes/Lena/vase.gcode", "job.file.fileName")
    assert file == "0:/gcodes/folder-1/file-1.gcode"
    assert anonymiser.command('M32 "0:/gcodes/Lena/vase.gcode"') == f'M32 "{file}"'
    assert anonymiser.command("M23 vase.gcode") == "M23 file-1.gcode"
    assert anonymiser.line("Error: vase.gcode not found") == "Error: file-1.gcode not found"
    reply = '{"err":0,"fileName":"0:/gcodes/Lena/vase.gcode","size":12}'
    assert json.loads(anonymiser.line(reply))["fileName"] == file


def test_the_key_is_a_part_of_the_path():
    anonymiser = Anonymiser()
    whole = anonymiser.model(MODEL)
    for key in ("tools", "tools[1].name", "tools[].name", "network", "heat.heaters[].state"):
        result = answer(MODEL, key, "d99vno")["result"]
        assert anonymiser.model(result, key) == answer(whole, key, "d99vno")["result"], key


COMMANDS = [
    ("G1 X1.5 Y-2 E.3 F6000", "G1 X1.5 Y-2 E.3 F6000"),
    ("N12 G1 X1*33", "N12 G1 X1*33"),
    ("G28 XY", "G28 XY"),
    ("T-1", "T-1"),
    ('M409 K"heat.heaters[0]" F"d99vn"', 'M409 K"heat.heaters[0]" F"d99vn"'),
    ('M409 K"global.doorCode"', 'M409 K"global.name-1"'),
    ("M568 P1 S200:205 R0", "M568 P1 S200:205 R0"),
    ("M104 S200 ; for Vera", "M104 S200 ;"),
    ("M117 Hello Vera 1234", "M117 word-1 word-2 word-3"),
    ("M550 PVera", "M550 word-1"),
    ("M552 S1 P192.168.1.3", "M552 word-1 word-2"),
    ("M540 P0:1:2:3:4:5", "M540 word-1"),
    ('M587 S"shed" P"swordfish"', "M587 word-1"),
    ('M98 P"homeall.g"', 'M98 P"homeall.g"'),
    ("M98 Pvera.g", "M98 file-1.g"),
    ("M30 my part.gcode", "M30 file-1.gcode"),
    ('M291 P"Well, Vera?" R"Note" S3', 'M291 P"text-1" R"text-2" S3'),
    ('set global.name = "Vera"', 'set word-1 = "text-1"'),
]


@pytest.mark.parametrize(("line", "shown"), COMMANDS, ids=[row[0] for row in COMMANDS])
def test_commands(line, shown):
    assert Anonymiser().command(line) == shown


LINES = [
    "ok",
    "ok T:20.0 /0.0 T0:20.0 /0.0 B:21.1 /60.0",
    "Error: G0/G1: target position outside machine limits",
    "Heater 1 fault: temperature excursion exceeded 15.0°C (target 200.0°C, actual 184.3°C)",
    "Resend: 12",
    "X:1.000 Y:2.000 Z:0.300 E:0.000",
    "Warning: Driver 0.3 warning: stalled",
    'Error: M98: File "0:/macros/folder-1/file-1.g" not found',
]


@pytest.mark.parametrize("line", LINES)
def test_what_the_firmware_says_stays(line):
    given = line.replace("folder-1", "Vera").replace("file-1", "open the shed")
    assert Anonymiser().line(given) == line


@given(OWN, st.sampled_from(["{}", "Error: {} not found", "echo {}", "ok {}", "M117 {}", "G1 {}"]))
def test_no_line_tells_what_a_person_has_put_in(text, form):
    line = form.format(text)
    anonymiser = Anonymiser()
    for shown in (anonymiser.line(line), anonymiser.command(line), anonymiser.sentence(line)):
        assert text not in shown


@given(OWN, st.sampled_from(['M587 S"{}"', "M98 P{}", 'M32 "{}"', 'M291 P"{}" S1', "M23 {}"]))
def test_no_command_tells_what_a_person_has_put_in(text, form):
    assert text not in Anonymiser().command(form.format(text))


@given(st.sampled_from(PLACES), OWN, st.integers(1), st.text(max_size=3))
def test_no_reply_does_however_it_is_broken(place, text, at, junk):
    key = place[0]
    result = put(MODEL, place, text)[key]
    whole = json.dumps({"key": key, "flags": "d99vno", "result": result}, ensure_ascii=False)
    anonymiser = Anonymiser()
    assert text not in anonymiser.reply(whole)
    at %= len(whole)
    for broken in (whole[:at], whole[:at] + junk + whole[at + 1 :]):
        shown = anonymiser.reply(broken)
        # a text that is broken itself may leave a letter or two, which is no text any more
        assert text not in shown


def test_a_broken_reply_shows_how_it_is_broken():
    broken = '{"key":"heat","flags":"","result":{"heaters":[{"state":"active","current":21.3'
    assert Anonymiser().reply(broken).startswith('{"key":"heat","flags":"","result":{"heaters":[{')
    assert Anonymiser().reply('{"key":"global","result":{"pin":1234') == UNREADABLE


@given(st.text(max_size=60))
def test_any_text_can_be_shown(text):
    anonymiser = Anonymiser()
    for show in (anonymiser.line, anonymiser.command, anonymiser.sentence, anonymiser.reply):
        assert isinstance(show(text), str)


def test_no_two_texts_share_a_name():
    names = Pseudonyms()
    texts = ["a", "a.gcode", "file-1.gcode", "name-1", "b.GCODE", "b.gcode"]
    given = [names.of(kind, text) for text in texts for kind in ("name", "folder", "word")]
    assert len(set(given)) == len(texts)
