"""Who gives a command another form on its way into OctoPrint's queue, made once, in order."""

from functools import partial

from .operation_translator import OperationTranslator
from .queued import QueuedCommands
from .script_filter import ScriptFilter
from .stop_commands import StopCommands
from .unsendable_commands import UnsendableCommands


def queued_commands(link, card, machine, *, notify, is_on, prompts):
    """Return the hook about what is about to be queued, with all that it asks.

    ``link`` is the ``SerialLink``, ``card`` the ``SdCard``, ``machine()`` the view of the model.
    ``notify(name, *arguments)`` must only take note and return. ``is_on(row)`` says whether a row
    of the table of operations is switched on. ``prompts(cmd, gcode, tags)`` translates answers to
    OctoPrint's own prompts.
    """
    refused = partial(notify, "refused_operation")
    unsendable = UnsendableCommands(
        machine,
        is_on,
        refused,
        paused=partial(notify, "print_waits"),
        stop=StopCommands(link, machine, card.is_others, is_on=is_on).instead,
    )
    return QueuedCommands(
        link,
        notify,
        unsendable.instead,
        translators=(
            # what must not go out at all is in no need of another form
            ScriptFilter(link, card, machine, is_on=is_on, tell=refused).translate,
            prompts,
            card.translate,
            OperationTranslator(machine, is_on, refused, profile=link.profile).translate,
        ),
    )
