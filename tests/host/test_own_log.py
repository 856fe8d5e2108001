"""The plugin's lines of the log, with what is put into its sentences apart."""

import ast
import logging

import pytest

from octoprint_rrfmodel.host.own_log import LOGGER, MOST_LENGTH, MOST_LINES, OwnLog
from tests.support.places import ROOT


@pytest.fixture
def log():
    kept = OwnLog()
    kept.start()
    yield kept
    kept.stop()


def test_sentence_and_values_are_apart(log):
    logger = logging.getLogger(f"{LOGGER}.polling")
    logger.warning("Could not read %s: %d %s", "vase.gcode", 5, OSError("no Vera"))
    logger.warning("There is no board")
    logging.getLogger("octoprint.plugins.other").warning("Not ours")
    first, second = log.latest()
    assert (first.level, first.logger) == ("WARNING", "polling")
    assert first.sentence == "Could not read %s: %d %s"
    assert first.values == ("vase.gcode", 5, "no Vera")
    assert second.values == () and second.error == "" and second.frames == ()


def test_what_was_raised_is_told_by_places_in_the_code(log):
    try:
        compile("1 +", "/home/vera/x.py", "exec")
    except SyntaxError:
        logging.getLogger(LOGGER).exception("Could not %s", "x" * 5000)
    (line,) = log.latest()
    assert line.error == "SyntaxError" and len(line.values[0]) == MOST_LENGTH
    assert line.frames and "vera" not in str(line.frames)


def test_it_is_bounded_and_ends(log):
    logger = logging.getLogger(LOGGER)
    for number in range(MOST_LINES + 5):
        logger.warning("Line %d", number)
    assert [line.values[0] for line in log.latest()] == [*range(5, MOST_LINES + 5)]
    log.stop()
    logger.warning("Later")
    assert log.latest()[-1].sentence == "Line %d"


def test_every_sentence_of_the_log_is_the_plugin_s_own():
    """A bundle shows sentences as they are, so nothing may be put into one beforehand."""
    made = []
    for path in (ROOT / "octoprint_rrfmodel").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            is_log = (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Attribute)
                and node.func.attr in ("debug", "info", "warning", "error", "exception")
                and ast.unparse(node.func.value).endswith(("_logger", "logger"))
            )
            # this one is handed the sentence, which is a constant there
            is_handed_on = path.name == "mqtt.py" and is_log
            if is_log and not is_handed_on and not isinstance(node.args[0], ast.Constant):
                made.append(f"{path.name}:{node.lineno}")
    assert made == []
