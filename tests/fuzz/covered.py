"""One target fed by Atheris, which looks for inputs that reach code not reached before.

A process of its own, as Atheris ends the one that it runs in:
``python -m tests.fuzz.covered NAME SECONDS COUNT_FILE``.
"""

import random
import sys
from pathlib import Path

import atheris
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

# only what is the plugin's is looked into
with atheris.instrument_imports(include=["octoprint_rrfmodel"]):
    from tests.fuzz.targets import BY_NAME

from hypothesis import HealthCheck, given, settings

from tests.fuzz.run import FOUND, Counted, watch_for_hangs

EVERY = 50
"""Inputs after which the count is written down: the process ends without a word."""

LONGEST = 8192


def main(name, seconds, count_file):
    """Feed the target until the time is over."""
    target = BY_NAME[name]
    counted = Counted(name, target.make)
    watch_for_hangs()

    def feed(given_input):
        if counted.inputs % EVERY == 0:
            Path(count_file).write_text(str(counted.inputs))
        counted(given_input)

    run = settings(database=None, deadline=None, suppress_health_check=list(HealthCheck))(
        given(target.inputs)(feed)
    )
    FOUND.mkdir(parents=True, exist_ok=True)
    # from nothing at all it would take long to come to anything that can be an input
    corpus = Path(count_file).with_name("corpus")
    corpus.mkdir(exist_ok=True)
    for number, length in enumerate((40, 200, 1000, 4000) * 4):
        (corpus / str(number)).write_bytes(random.Random(number).randbytes(length))
    arguments = [
        sys.argv[0],
        str(corpus),
        f"-max_total_time={seconds}",
        f"-max_len={LONGEST}",
        f"-artifact_prefix={FOUND}/atheris-",
        "-verbosity=0",
        "-handle_alrm=0",
    ]
    atheris.Setup(arguments, run.hypothesis.fuzz_one_input)
    atheris.Fuzz()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3])
