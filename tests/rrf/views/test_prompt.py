"""Message boxes of every mode as prompts, and what each button sends by firmware version."""

import pytest

from octoprint_rrfmodel.rrf.views.prompt import MODES, answer, buttons, prompt

NEW, OLD = (3, 5, 0), (3, 4, 6)


def box(mode, **members):
    return {"mode": mode, "seq": 7, "title": "Title", "message": "Text", **members}


CHOICES = ["PLA", "ABS", "<b>PETG</b>"]

# box, words on the buttons, commands of 3.5 and of 3.4
TABLE = [
    pytest.param(box(0), [], [], [], id="no buttons"),
    pytest.param(box(1), ["Close"], ["M292 P0 S7"], ["M292 P0"], id="close"),
    pytest.param(box(2), ["OK"], ["M292 P0 S7"], ["M292 P0"], id="ok"),
    pytest.param(
        box(3), ["OK", "Cancel"], ["M292 P0 S7", "M292 P1 S7"], ["M292 P0", "M292 P1"], id="cancel"
    ),
    pytest.param(
        box(3, cancelButton=True),
        ["OK", "Cancel"],
        ["M292 P0 S7", "M292 P1 S7"],
        ["M292 P0", "M292 P1"],
        id="cancel told twice",
    ),
    pytest.param(
        box(2, cancelButton=True),
        ["OK", "Cancel"],
        ["M292 P0 S7", "M292 P1 S7"],
        ["M292 P0", "M292 P1"],
        id="ok that can be cancelled",
    ),
    pytest.param(
        box(4, choices=CHOICES, cancelButton=True),
        ["PLA", "ABS", "PETG", "Cancel"],
        ["M292 R{0} S7", "M292 R{1} S7", "M292 R{2} S7", "M292 P1 S7"],
        None,
        id="choices and cancel",
    ),
    pytest.param(
        box(4, choices=CHOICES, cancelButton=False),
        ["PLA", "ABS", "PETG"],
        ["M292 R{0} S7", "M292 R{1} S7", "M292 R{2} S7"],
        None,
        id="choices",
    ),
    pytest.param(box(4, choices=None), [], [], None, id="no choices"),
    pytest.param(box(5), [], [], None, id="whole number"),
    pytest.param(box(6, cancelButton=True), ["Cancel"], ["M292 P1 S7"], None, id="number"),
    pytest.param(box(7, cancelButton=True), ["Cancel"], ["M292 P1 S7"], None, id="text"),
    pytest.param(box(99), [], [], [], id="mode of the future"),
    pytest.param(box("2"), [], [], [], id="no mode"),
]


@pytest.mark.parametrize("box, words, new, old", TABLE)
def test_buttons_and_answers(box, words, new, old):
    begin, *choices, show = prompt(box)
    assert (begin, show) == (("prompt_begin", "Title: Text"), ("prompt_show", ""))
    assert choices == [("prompt_choice", word) for word in words]
    assert [answer(box, index, NEW) for index in range(len(words))] == new
    if old is not None:
        assert [answer(box, index, OLD) for index in range(len(words))] == old
    assert answer(box, len(words), NEW) is answer(box, -1, NEW) is None


def test_every_mode_is_in_the_table():
    assert {row.values[0]["mode"] for row in TABLE} >= set(MODES)


def test_only_the_text_where_nobody_can_answer():
    assert prompt(box(3), is_answerable=False) == [
        ("prompt_begin", "Title: Text"),
        ("prompt_show", ""),
    ]


def test_words_are_the_hosts():
    words = {"ok": "Gut", "cancel": "Abbrechen", "close": "Schließen"}
    shown = prompt(box(3), words=words)
    assert [text for name, text in shown if name == "prompt_choice"] == ["Gut", "Abbrechen"]


@pytest.mark.parametrize(
    "title, message, text",
    [
        ("", "Text", "Text"),
        (None, "Text", "Text"),
        ("Title", "", "Title"),
        ("A<br>B", "one<br/>two\nthree\r\n\tfour", "A B: one two three four"),
        ("", "<b>hot</b>: 5 < 6 > 4", "hot : 5 < 6 > 4"),
        ("", "a\0b\x1b[31m", "a b [31m"),
        ("", "Prüfen – jetzt", "Prüfen – jetzt"),
    ],
    ids=repr,
)
def test_text_is_one_plain_line(title, message, text):
    assert prompt(box(2, title=title, message=message))[0] == ("prompt_begin", text)


@pytest.mark.parametrize("seq", [None, "7; M112", 7.5])
def test_only_a_number_is_a_number(seq):
    assert answer(box(2, seq=seq), 0, NEW) == "M292 P0"


def test_nonsense_has_no_buttons():
    assert buttons({}) == []
    assert prompt({}) == [("prompt_begin", ""), ("prompt_show", "")]
