"""Where in a line the reply is; the ``ok`` around it is OctoPrint's and must not get lost."""

import contextlib
import json

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.wire.line import find_reply, without_warning
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply, ModelReply, StatusReply, decode
from tests.support.examples import some

from ..strategies import ANY_JSON, VALUES, compact, model_reply

LIVE = '{"key":"","flags":"d99fin","result":{"state":{"status":"idle"}}}'
STATE = '{"key":"state","flags":"d99vno","result":{"status":"idle","displayMessage":"a}b{c"}}'
LEGACY = '{"status":"I","heaters":[25.0,29.0],"pos":[0.000,0.000]}'
STATUS = '{"status":"I","coords":{"axesHomed":[0,0,0]},"time":53.0}'
CONFIG = '{"axisMins":[0.00,0.00],"firmwareDate":"2020-01-03b3", "sysdir":"0:/sys/"}'
NO_ROOM = '{"err":-1}'
NAN = '{"status":"I","pos":[nan,-nan,inf,0.000]}'
FOLDER = '{"dir":"0:/","files":[{"type":"f","name":"{\\"key\\":"}],"next":0}'
FILE = '{"err":0,"fileName":"a.g","customInfo":{"key":"x","status":1}}'
OLD_FILE = '{"err":0,"size":5,"generatedBy":"x","printDuration":1,"fileName":"a.g"}'
NO_FILE = '{"err":1,"fileName":"a.g"}'
PIECE = '{"thumbnail":{"fileName":"a.g","offset":5,"data":"QUJD","next":0,"err":0}}'
SPOILT = '{"status":"I","machine":[150.000 ,150.005.000],"time":1}'
UNDER_VOLTAGE = "Warning: VIN under-voltage event (11.0V)"

# line, reply, rest
FOUND = {
    "live root": (LIVE, LIVE, ""),
    "line end": (LIVE + "\n", LIVE, ""),
    "line end of two": (LIVE + "\r\n", LIVE, ""),
    "key": (STATE, STATE, ""),
    "S0": (LEGACY, LEGACY, ""),
    "S2 to S4": (STATUS, STATUS, ""),
    "S5": (CONFIG, CONFIG, ""),
    "folder": (FOLDER + "\n", FOLDER, ""),
    "file information with a slicer's members": (FILE + "\n", FILE, ""),
    "file information, ok behind": (FILE + "ok", FILE, "ok"),
    "file being printed before 3.1": (OLD_FILE + "\n", OLD_FILE, ""),
    "file that isn't there": (NO_FILE, NO_FILE, ""),
    "piece of a thumbnail, glued before": (UNDER_VOLTAGE + PIECE, PIECE, UNDER_VOLTAGE),
    "no buffers": (NO_ROOM + "\n", NO_ROOM, ""),
    "nan": (NAN, NAN, ""),
    "glued before": (UNDER_VOLTAGE + LIVE + "\n", LIVE, UNDER_VOLTAGE),
    "glued behind": (LIVE + UNDER_VOLTAGE + "\n", LIVE, UNDER_VOLTAGE),
    "glued on both sides": ("Heater 1}" + LIVE + "{x}", LIVE, "Heater 1} {x}"),
    "ok before": ("ok " + LIVE, LIVE, "ok"),
    "ok glued before": ("ok" + LIVE, LIVE, "ok"),
    "ok with temperatures before": ("ok T:21.3 /0.0" + LIVE, LIVE, "ok T:21.3 /0.0"),
    "ok glued behind": (LIVE + "ok\n", LIVE, "ok"),
    "ok with temperatures behind": (LIVE + "ok T:21.3 /0.0\n", LIVE, "ok T:21.3 /0.0"),
    "ok before and text behind": ("ok" + LIVE + UNDER_VOLTAGE, LIVE, "ok " + UNDER_VOLTAGE),
    "text before and ok behind": (UNDER_VOLTAGE + LIVE + "ok", LIVE, "ok " + UNDER_VOLTAGE),
    "no buffers, ok behind": (NO_ROOM + "ok\n", NO_ROOM, "ok"),
    "no buffers, glued before": (UNDER_VOLTAGE + NO_ROOM, NO_ROOM, UNDER_VOLTAGE),
    "S2, ok behind": (STATUS + "ok\n", STATUS, "ok"),
    "nan, ok behind": (NAN + "ok", NAN, "ok"),
    "nan, ok with temperatures behind": (NAN + "ok T:20.0 /0.0", NAN, "ok T:20.0 /0.0"),
    "spoilt, text behind": (SPOILT + UNDER_VOLTAGE, SPOILT, UNDER_VOLTAGE),
    "braces behind": (LIVE + "Printed {object}", LIVE, "Printed {object}"),
    "ok and braces behind": (LIVE + "ok {1}", LIVE, "ok {1}"),
    "another JSON behind": (LIVE + '{"seq":3,"resp":""}', LIVE, '{"seq":3,"resp":""}'),
    "two replies": (NO_ROOM + LIVE, NO_ROOM, LIVE),
    "the same reply twice": (LIVE + LIVE, LIVE, LIVE),
    "M408 twice": (STATUS + STATUS, STATUS, STATUS),
    "NUL bytes around": ("\0\0" + LIVE + "\0", LIVE, ""),
    "blanks around": ("  " + LIVE + "  \n", LIVE, ""),
    "truncated": (STATE[:50], STATE[:50], ""),
    "truncated, ok behind": (STATE[:50] + "ok\n", STATE[:50], "ok"),
    "truncated in a text": (STATE[:-8] + "ok", STATE[:-8], "ok"),
    "truncated, text before": (UNDER_VOLTAGE + STATE[:50], STATE[:50], UNDER_VOLTAGE),
    "truncated behind its start": ('{"key":', '{"key":', ""),
    "truncated behind its start, ok": ('{"key":ok', '{"key":', "ok"),
    "replacement characters": (LIVE.replace("idle", "\ufffd"), LIVE.replace("idle", "\ufffd"), ""),
    "latin-1": (LIVE.replace("idle", "25\xb0C"), LIVE.replace("idle", "25\xb0C"), ""),
    "no-break space behind": (LIVE + "\xa0ok", LIVE, "\xa0ok"),
    "control character in a text": (LIVE.replace("idle", "\x01"), LIVE.replace("idle", "\x01"), ""),
}

NOT_FOUND = {
    "empty": "",
    "line end": "\n",
    "ok": "ok\n",
    "temperatures": "ok T:21.3 /0.0 T0:21.3 /0.0 B:60.0 /60.0",
    "braces in a text": "echo: {move.axes[0]} is {12}",
    "quotes in a text": 'M118 S"{""key"": 1}" not found',
    "start cut off": LIVE[5:],
    "slicer's member called status": '{"err":0,"customInfo":{"status":"x"}}',
    "card": '{"SDinfo":{"slot":0,"present":1}}',
    "panel's message": '{"seq":3,"resp":"{\\"key\\":1}"}',
    "beep": '{"beep_freq":1000,"beep_length":100}',
    "other error number": '{"err":-12}',
}


@pytest.mark.parametrize(("line", "reply", "rest"), FOUND.values(), ids=FOUND)
def test_reply_is_found_and_the_rest_kept(line, reply, rest):
    assert find_reply(line) == (reply, rest, None)


@pytest.mark.parametrize("line", NOT_FOUND.values(), ids=NOT_FOUND)
def test_other_lines_are_left_alone(line):
    assert find_reply(line) is None


@pytest.mark.parametrize("around", [("", ""), ("ok", ""), ("", "ok"), ("Warning: x", "ok")])
def test_line_of_64_kilobytes_is_found(around):
    reply = model_reply({"state": ["x}" * 1000 + "{" * 1000] * 22})
    assert len(reply) > 64 * 1024
    before, after = around
    found = find_reply(before + reply + after)
    assert found.reply == reply
    assert all(text in found.rest for text in around)


KINDS = {
    "live root": LIVE,
    "list that goes on": '{"key":"tools","flags":"d99vno","result":[{"number":0}],"next":3}',
    "S0": LEGACY,
    "S2 to S4": STATUS,
    "S2 with nan": NAN,
    "S5": CONFIG,
    "folder": FOLDER,
    "file": FILE,
    "no file": NO_FILE,
    "piece of a thumbnail": PIECE,
    "no buffers": NO_ROOM,
    "start-up error": '{"key":"state","flags":"","result":{"startupError":{"file":"a","line":7}}}',
}


def places(text):
    """Yield the reply with the member at each place of its outermost object, first to last."""
    level, in_text, at = 0, False, [1]
    for index, letter in enumerate(text):
        if letter == '"' and text[index - 1] != "\\":
            in_text = not in_text
        elif not in_text:
            level += (letter in "{[") - (letter in "}]")
            if letter == "," and level == 1:
                at.append(index + 1)
    for index in at:
        yield text[:index] + '"line":1234,' + text[index:]
    yield text[:-1] + ',"line":1234}'


@pytest.mark.parametrize("around", [("", "\n"), (UNDER_VOLTAGE, "\n"), ("", "ok\n")])
@pytest.mark.parametrize("reply", KINDS.values(), ids=KINDS)
def test_row_8_number_of_the_command_may_stand_anywhere(reply, around):
    for numbered in places(reply):
        found = find_reply(around[0] + numbered + around[1])
        assert found is not None, numbered
        assert (found.reply, found.number) == (reply, 1234), numbered
        assert found.rest == (around[0] or around[1].strip())


@pytest.mark.parametrize("reply", KINDS.values(), ids=KINDS)
def test_other_members_of_that_name_are_no_number(reply):
    found = find_reply(reply)
    assert (found.reply, found.number) == (reply, None)


@pytest.mark.parametrize(
    "text",
    [
        '{"line":12,',
        '{"line":12,"key":"","flags"',
        '{"line":' + "9" * 5000 + ',"key":""}',
        '{"line":"x","key":""}',
        '{"key":"","line":-1}',
        '{"key":"","line":1.5,"result":1}',
        '{"key":"","line":',
    ],
)
def test_spoilt_number_raises_nothing(text):
    for line in (text, text + "ok\n"):
        found = find_reply(line)
        assert found is None or type(found.number) in (int, type(None))


BOMBS = {
    "objects": '{"key":' * 100000,
    "lists": '{"key":"","flags":"","result":' + "[" * 100000,
    "lists that end": '{"key":"","flags":"","result":' + "[" * 100000 + "]" * 100000 + "}",
    "objects that end": '{"status":' * 50000 + "1" + "}" * 50000,
    "quotes": '{"status":"' + '\\"' * 100000,
    "quotes and nan": '{"status":nan,"x":"' + '\\"' * 100000,
}


@pytest.mark.parametrize("bomb", BOMBS.values(), ids=BOMBS)
def test_nesting_bomb_is_a_malformed_reply_and_loses_no_ok(bomb):
    found = find_reply(bomb + "ok\n")
    assert found.rest == "ok"
    with pytest.raises(MalformedReply):
        decode(found.reply)


# a text that starts or ends so would be JSON that goes on or comes before
AROUND = st.text(max_size=30).filter(
    lambda text: '"' not in text and text[:1] not in tuple(",]}") and text[-1:] != ","
)

REPLIES = st.one_of(
    st.builds(model_reply, VALUES),
    st.builds(model_reply, VALUES, key=st.sampled_from(["heat", 'global.a"b']), next=st.just(3)),
    st.builds(lambda value: compact({"status": "I", "x": value}), VALUES),
    st.sampled_from([NO_ROOM, NAN, CONFIG, SPOILT]),
)


@settings(max_examples=some(150))
@given(AROUND, REPLIES, AROUND)
@example("", LIVE, "ok {1}")
@example("", NAN, "ok }")
def test_whatever_stands_around_a_reply_is_kept(before, reply, after):
    found = find_reply(before + reply + after)
    assert found.reply == reply
    assert before.strip("\0 \t\r\n") in found.rest
    assert after.strip("\0 \t\r\n").rstrip() in found.rest


@settings(max_examples=some(100))
@given(st.sampled_from(["", "Warning: x", "{x}"]), REPLIES, st.sampled_from(["ok", "ok T:20.0"]))
def test_ok_behind_a_reply_comes_first(before, reply, ok):
    assert find_reply(before + reply + ok + "\n").rest.startswith(ok)


@settings(max_examples=some(100))
@given(REPLIES, st.integers(1, 200), st.booleans())
def test_ok_behind_a_truncated_reply_is_kept(reply, length, has_ok):
    cut = reply[: 11 + length]
    found = find_reply(cut + "ok\n" if has_ok else cut)
    if has_ok and found is not None:
        assert found.rest.startswith("ok")
    elif has_ok:
        assert reply == NO_ROOM or cut == reply


@settings(max_examples=some(150))
@given(st.text() | st.text('{}"key:\\,[]status0ok\0', max_size=60), st.sampled_from(["", *FOUND]))
def test_search_never_raises(text, name):
    line = FOUND[name][0] if name else ""
    for candidate in (text, line + text, text + line):
        found = find_reply(candidate)
        if found is not None:
            assert found.reply in candidate
            with contextlib.suppress(MalformedReply):
                decode(found.reply)


@settings(max_examples=some(100))
@given(ANY_JSON)
def test_reply_is_read_as_it_was_written(value):
    text = json.dumps({"key": "", "flags": "f", "result": value}, separators=(",", ":"))
    reply = decode(find_reply("ok " + text + "ok").reply)
    assert isinstance(reply, ModelReply)


def test_kinds_of_reply_are_told_apart():
    assert isinstance(decode(find_reply(LIVE).reply), ModelReply)
    assert isinstance(decode(find_reply(STATUS).reply), StatusReply)
    assert isinstance(decode(find_reply(CONFIG).reply), StatusReply)


GLUED = {
    "alone": (UNDER_VOLTAGE + "ok\n", "ok\n"),
    "temperatures": (UNDER_VOLTAGE + "ok T0:21.3 /0.0\n", "ok T0:21.3 /0.0\n"),
    "twice": (UNDER_VOLTAGE * 2 + "ok\n", "ok\n"),
    "no ok": (UNDER_VOLTAGE + "\n", UNDER_VOLTAGE + "\n"),
    "another word": (UNDER_VOLTAGE + "okay\n", UNDER_VOLTAGE + "okay\n"),
    "another warning": ("Warning: all is ok\n", "Warning: all is ok\n"),
    "somebody's text": ('say "(1V)ok"\n', 'say "(1V)ok"\n'),
    "ok": ("ok\n", "ok\n"),
}


@pytest.mark.parametrize(("line", "expected"), GLUED.values(), ids=GLUED)
def test_ok_behind_a_warning_is_one(line, expected):
    assert without_warning(line) == expected
