"""Who gives a command another form on its way into OctoPrint's queue, made once, in order."""

from functools import partial

from .file_lines import FileLines
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
    files = FileLines(link)
    stops = StopCommands(link, files, machine, is_others=card.is_others, is_on=is_on)
    unsendable = UnsendableCommands(machine, is_on, notify, stop=stops.instead, files=files)
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
