"""Macro files are looked up once, when somebody asks, and again when the card has changed."""

import asyncio
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from tornado.ioloop import IOLoop

from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.web.moonraker.macro_files import MOST_FOLDERS, MacroFiles
from tests.support import coroutines


class Card:
    """Folders with their entries; counts how often it was asked."""

    def __init__(self):
        self.folders = {
            "0:/macros": [("b.g", False), ("sub", True), ("a.g", False)],
            "0:/macros/sub": [("c.g", False)],
        }
        self.asked = []
        self.changes = "1"
        self.refusal = None
        self.found = None

    async def entries(self, path):
        self.asked.append(path)
        if path not in self.folders:
            raise RequestRefused(404, "The machine has no such folder.")
        return [{"name": name, "folder": is_folder} for name, is_folder in self.folders[path]]

    def macros(self):
        questions = SimpleNamespace(
            changes_of_the_card=lambda: self.changes, refusal_of_the_card=lambda: self.refusal
        )
        return MacroFiles(self._take, IOLoop.current(), self, questions=questions)

    def _take(self, paths):
        self.found = paths


def run(test):
    coroutines.run(test(Card()))


def wait(macros):
    """Wait as a thread of OctoPrint's does."""
    return asyncio.get_running_loop().run_in_executor(None, macros.wait)


def test_all_folders_in_order_and_once():
    async def test(card):
        macros = card.macros()
        await wait(macros)
        assert card.found == ("0:/macros/a.g", "0:/macros/b.g", "0:/macros/sub/c.g")
        await wait(macros)
        assert len(card.asked) == 2
        card.changes = "2"
        await asyncio.gather(wait(macros), wait(macros))
        assert len(card.asked) == 4

    run(test)


def test_nobody_asks_while_the_card_may_not_be_asked_about():
    async def test(card):
        macros = card.macros()
        card.refusal = "OctoPrint prints."
        await wait(macros)
        assert card.asked == [] and card.found is None

    run(test)


def test_the_loop_s_own_thread_does_not_wait():
    async def test(card):
        macros = card.macros()
        macros.wait()
        assert card.asked == []

    run(test)


def test_what_fails_is_not_asked_for_again_at_once():
    async def test(card):
        macros = card.macros()
        card.folders.clear()
        await wait(macros)
        await wait(macros)
        assert card.asked == ["0:/macros"] and card.found is None

    run(test)


def test_no_more_folders_than_others_can_wait_for():
    async def test(card):
        card.folders = {
            "0:/macros": [(f"{number}", True) for number in range(100)],
            **{f"0:/macros/{number}": [("a.g", False)] for number in range(100)},
        }
        await wait(card.macros())
        assert len(card.asked) == MOST_FOLDERS == len(card.found) + 1

    run(test)
