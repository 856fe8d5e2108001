"""One target fed for so many seconds: inputs counted, and what was found kept to be run again."""

import hashlib
import pickle
import signal
import time
import traceback
from typing import NamedTuple

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis.errors import StopTest, UnsatisfiedAssumption
from hypothesis.stateful import run_state_machine_as_test

from tests.support.places import ROOT

FOUND = ROOT / ".artifacts" / "fuzz"

HANGS_SECONDS = 10
"""Of the clock; a busy machine may make anything slow."""

BATCH = 100

RUNS, STEPS = 5, 25
"""Of a state machine at a time, and what happens in each."""

AGAIN = "python -m tests.fuzz --again"


class Outcome(NamedTuple):
    """What became of a target."""

    inputs: int
    found: tuple[str, ...]
    """Paths of the inputs that broke something."""


class Counted:
    """Feeds a function, counts, and keeps what breaks it."""

    def __init__(self, name, make):
        self.name = name
        self._make = make
        self.inputs = 0
        self.found = []

    def __call__(self, given_input):
        """Feed it; raise what it raises."""
        self.inputs += 1
        signal.setitimer(signal.ITIMER_REAL, HANGS_SECONDS)
        try:
            self._make()(given_input)
        except (StopTest, UnsatisfiedAssumption):
            raise
        except BaseException as error:
            self.found.append(kept(self.name, given_input, error))
            raise
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)


def watch_for_hangs():
    """Let what takes too long raise."""

    def hangs(number, frame):
        raise TimeoutError(f"more than {HANGS_SECONDS} s for one input")

    signal.signal(signal.SIGALRM, hangs)


def file_name(name):
    """Return how the files begin of what a target has found."""
    return name.replace(" ", "_")


def kept(name, given_input, error):
    """Write down an input and what it led to; return the path."""
    try:
        data = pickle.dumps((name, given_input))
    except Exception:
        # made by somebody else's classes: it can be read, and written once more by hand
        data = pickle.dumps((name, repr(given_input)))
    FOUND.mkdir(parents=True, exist_ok=True)
    path = FOUND / f"{file_name(name)}-{hashlib.sha256(data).hexdigest()[:12]}.pickle"
    path.write_bytes(data)
    text = "".join(traceback.format_exception(error))
    path.with_suffix(".txt").write_text(f"{given_input!r}\n\n{text}\n{AGAIN} {path}\n")
    return str(path)


def with_machine(name, machine, seconds, first_seed):
    """Run a state machine until the time is over, or something is found; count its runs."""
    until = time.monotonic() + seconds
    number, runs, found = first_seed, 0, []
    while time.monotonic() < until and not found:
        number += 1
        # a class of its own, which takes the seed
        made = seed(number)(type(machine.__name__, (machine,), {}))
        try:
            run_state_machine_as_test(
                made,
                settings=settings(
                    max_examples=RUNS,
                    stateful_step_count=STEPS,
                    deadline=None,
                    database=None,
                    phases=[Phase.generate],
                    suppress_health_check=list(HealthCheck),
                ),
            )
        except Exception as error:
            found.append(kept(name, f"seed {number}", error))
        runs += RUNS
    return Outcome(runs, tuple(found))


def with_hypothesis(counted, inputs, seconds, first_seed):
    """Feed what Hypothesis makes until the time is over, or something is found."""
    until = time.monotonic() + seconds
    number = first_seed
    while time.monotonic() < until and not counted.found:
        number += 1
        run = settings(
            max_examples=BATCH,
            deadline=None,
            database=None,
            phases=[Phase.generate],
            suppress_health_check=list(HealthCheck),
        )(seed(number)(given(inputs)(counted.__call__)))
        try:
            run()
        except Exception:
            if not counted.found:
                raise
    return Outcome(counted.inputs, tuple(dict.fromkeys(counted.found)))
