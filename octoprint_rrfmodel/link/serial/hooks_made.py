"""What answers OctoPrint's hooks about its serial line, made once."""

from functools import partial
from typing import NamedTuple

from ..terminal import TerminalFilter
from .display import Display
from .patience import Patience
from .received import ReceivedLines
from .refused_lines import RefusedLines
from .sdupload import UploadRefusal
from .sent import SentCommands
from .simulated_port import SimulatedPort
from .way_out import queued_commands


class SerialHooks(NamedTuple):
    """Each part, by what it is about."""

    display: Display
    received: ReceivedLines
    queued: object
    sent: SentCommands
    uploads: UploadRefusal
    terminal: TerminalFilter
    simulated_port: SimulatedPort


def serial_hooks(host, link, card, *, known, notify, clock, guard, **told):
    """Return the parts; ``link`` is the ``SerialLink``, ``card`` the ``SdCard``.

    ``told`` are ``is_stale()``, ``waits_for_a_person()``, ``sent(cmd, tags)`` and
    ``prompts(cmd, gcode, tags)``.
    """
    display = Display(link, known, told["is_stale"], fire=host.fire)
    return SerialHooks(
        display=display,
        received=ReceivedLines(
            link,
            card,
            notify,
            guards=guard.handles,
            patience=Patience(link, host.silence_minutes, told["waits_for_a_person"]),
            refusals=RefusedLines(link, notify, stops=guard.stops, clock=clock),
        ),
        queued=queued_commands(
            link,
            card,
            known.machine,
            notify=notify,
            is_on=partial(host.is_set, "operations"),
            prompts=told["prompts"],
        ),
        sent=SentCommands(
            link,
            notify,
            clock,
            show_target=display.show_target,
            sent=told["sent"],
            is_shown=display.is_shown,
        ),
        uploads=UploadRefusal(link),
        terminal=TerminalFilter(host.is_set, link),
        simulated_port=SimulatedPort(host.simulator),
    )
