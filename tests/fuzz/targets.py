"""All that takes what others send, as one table: how its input is made, and what must hold.

A row's ``make()`` gives the function that is fed, with whatever it keeps between two inputs made
anew. It raises where something doesn't hold. ``make test`` goes over the table with a few inputs
each, ``make fuzz`` for as long as it is told. Requests and frames that go to a real OctoPrint are
in ``served``.
"""

from __future__ import annotations

import contextlib
import json
from functools import partial
from typing import Any, Callable, NamedTuple

from hypothesis import strategies as st

from octoprint_rrfmodel.host.tags import POLL_TAG
from octoprint_rrfmodel.link.questions import refusal_to_send
from octoprint_rrfmodel.link.serial.operation_translator import OPERATION_OF_TAG
from octoprint_rrfmodel.rrf.card.listing import Aliases, CardFile, CardPlan
from octoprint_rrfmodel.rrf.card.qoi import NotQoi, png_of
from octoprint_rrfmodel.rrf.card.thumbnail import best, decode_file, decode_piece, picture
from octoprint_rrfmodel.rrf.follow.asked import answer_to
from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.gcode.file_check import check as check_file
from octoprint_rrfmodel.rrf.gcode.quotes import has_odd_quote, without_comment
from octoprint_rrfmodel.rrf.gcode.unsendable import text_of_box, waits_for_answer, without_texts
from octoprint_rrfmodel.rrf.m409 import answer
from octoprint_rrfmodel.rrf.model.keys import Key, MalformedKey
from octoprint_rrfmodel.rrf.wire.gcode_words import apart, texts, words
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply, decode_page
from octoprint_rrfmodel.rrf.wire.request import (
    FileRequest,
    ListRequest,
    ModelRequest,
    PieceRequest,
)
from octoprint_rrfmodel.web.moonraker import jsonrpc
from tests.rrf.board import machine

from .hostile import LINES
from .line_rig import LOOKS, Rig, is_answer
from .made import (
    COMMANDS,
    FILE_REPLIES,
    FILES,
    FLAGS,
    FRAMES,
    KEYS,
    MODEL_REPLIES,
    MODELS,
    PAGES,
    PICTURES,
)


class Target(NamedTuple):
    """One row."""

    name: str
    inputs: Any
    """A Hypothesis strategy."""
    make: Callable[[], Callable[[Any], object]]
    long: Callable[[], Callable[[str], object]] | None = None
    """Makes the function whose time is looked at, for what takes a text alone: that may be as long
    and as hostile as it likes."""


REQUESTS = (
    ModelRequest("heat", "d99vno"),
    ListRequest("0:/gcodes"),
    FileRequest("a.gcode"),
    PieceRequest("a.gcode", 0),
)


def strict(text):
    """Return what a text says, which has to be JSON as everybody reads it."""

    def refuse(word):
        raise AssertionError(f"{word} is no JSON")

    return json.loads(text, parse_constant=refuse)


def twice(make):
    """Let the same line mean the same, whoever has looked before."""

    def look(line):
        assert repr(make()(line)) == repr(make()(line))

    return look


def every_line():
    looks = [twice(make) for make in LOOKS.values()]

    def look(line):
        for each in looks:
            each(line)

    return look


def conversation():
    def hear(said):
        lines, awaited = said
        rig = Rig()
        rig.link.awaited = awaited
        rig.link.asks_of_a_file = awaited == "M36"
        rig.link.extra_ok.awaits = "error" if awaited == "M120" else None
        for line in lines:
            assert isinstance(rig.hear(line), str)
            assert rig.received.on_error(rig.comm, line) in (True, False)
        # whatever the board says, nothing is sent because of it
        assert rig.link.take_asked() is None

    return hear


def queued():
    def queue(given):
        model, tag, command = given
        rig = Rig()
        rig.model = model
        gcode = "T" if command.startswith("T") else command.split()[0]
        said = rig.queued.on_queuing(rig.comm, "queuing", command, None, gcode, tags={tag})
        assert is_answer(said)
        tags = {POLL_TAG}
        assert rig.sent.on_sending(rig.comm, "sending", command, None, gcode, tags=tags) is None

    return queue


def look_at_command(line):
    for look in (words, texts, has_odd_quote, without_comment, without_texts, text_of_box):
        look(line)
    waits_for_answer(line)
    assert all(isinstance(part, str) for part in apart(line))


def follower():
    made = Follower()

    def take(text):
        before = made.store.model
        try:
            made.take(text)
        except MalformedReply:
            assert made.store.model is before
        # whatever came, there is something to ask next
        assert made.next_request().line

    return take


def ask(text):
    for request in REQUESTS:
        with contextlib.suppress(MalformedReply):
            answer_to(request, text)


def card():
    plan = CardPlan()
    plan.observe(machine())

    def take(text):
        try:
            page = decode_page(text)
        except MalformedReply:
            plan.failed()
            return
        plan.take(page)
        plan.next_request()

    return take


def alias(names):
    index = Aliases().index([CardFile(name, 1, None) for name in names])
    for name in names:
        found = index.alias_of(name)
        # names compare without case, as on the card
        assert index.file_of(found).path.lower() == name.lower()


def look_at_file(text):
    with contextlib.suppress(MalformedReply):
        _, file = decode_file(text)
        if file is not None:
            best(file.thumbnails)
    with contextlib.suppress(MalformedReply):
        decode_piece(text)


def look_at_picture(letters):
    found = picture(letters)
    assert found is None or found.data


def decode_qoi(data):
    with contextlib.suppress(NotQoi):
        png_of(data)


def look_at_key(given):
    text, flags, model = given
    told = answer(model, text, flags)
    assert {"key", "flags", "result"} <= told.keys()
    refusal_to_send(text, flags)
    with contextlib.suppress(MalformedKey):
        key = Key(text)
        key.value(model)
        assert not key.touches(None)


def long_key(text):
    look_at_key((text, "", machine()))
    look_at_key(("heat", text, machine()))


def frames():
    def run(method, params):
        if method not in ("server.info", "printer.objects.query"):
            raise jsonrpc.RpcError(jsonrpc.METHOD_NOT_FOUND, f"There is no method {method[:100]}.")
        return params

    def take(text):
        said = jsonrpc.respond(text, run)
        if said is not None:
            strict(said)

    return take


def reused(look):
    """Return the ``make`` of a function that keeps nothing."""
    return lambda: look


TEXTS = st.text(max_size=60)

TARGETS = (
    *(
        Target(f"line {name}", LINES | st.text(), partial(twice, make), make)
        for name, make in LOOKS.items()
    ),
    Target(
        "lines in a row",
        st.tuples(
            st.lists(LINES | st.text(), max_size=5),
            st.sampled_from((None, "M36", "M120", "M20")),
        ),
        conversation,
    ),
    Target("reply followed", MODEL_REPLIES | LINES, follower, follower),
    Target("reply asked for", MODEL_REPLIES | PAGES | FILE_REPLIES, reused(ask), reused(ask)),
    Target("card list", PAGES, card, card),
    Target("card names", st.lists(TEXTS, max_size=8, unique=True), reused(alias)),
    Target("file of the card", FILE_REPLIES, reused(look_at_file), reused(look_at_file)),
    Target("thumbnail", PICTURES | TEXTS, reused(look_at_picture), reused(look_at_picture)),
    Target("thumbnail qoi", st.binary(max_size=400), reused(decode_qoi)),
    Target(
        "command queued",
        st.tuples(MODELS, st.sampled_from(sorted(OPERATION_OF_TAG)), COMMANDS),
        queued,
    ),
    Target(
        "command words",
        COMMANDS | LINES | st.text(),
        reused(look_at_command),
        reused(look_at_command),
    ),
    Target("file to print", FILES, reused(check_file)),
    Target("key", st.tuples(KEYS, FLAGS, MODELS), reused(look_at_key)),
    Target("key long", KEYS, reused(long_key), reused(long_key)),
    Target("frame", FRAMES, frames, frames),
)

EVERY_LINE = Target("line, all that see it", LINES | st.text(), every_line)

BY_COVERAGE = (EVERY_LINE, *(row for row in TARGETS if not row.name.startswith("line ")))
"""What Atheris is given, a process each: all that see a line share one."""

BY_NAME = {target.name: target for target in (*TARGETS, EVERY_LINE)}
