"""The parts of this floor, made together."""

from typing import NamedTuple

from .file_check import FileCheck
from .message_boxes import MessageBoxes
from .print_guard import PrintGuard
from .recovery import Recovery
from .warning_list import WarningList


class Guards(NamedTuple):
    """What looks after the machine and OctoPrint's print."""

    boxes: MessageBoxes
    guard: PrintGuard
    recovery: Recovery
    warnings: WarningList
    file_check: FileCheck


def make_guards(host, link, known, *, notifications, problems, show_box, clock):
    """Return the parts; ``host`` is OctoPrint, ``known`` what is known of the machine.

    ``show_box(box)`` puts a message box into the model, ``None`` for none.
    """
    model = known.model
    boxes = MessageBoxes(model, clock, link=link, tell=notifications.tell, show=show_box)
    guard = PrintGuard(
        host.printer,
        link.has_a_print,
        model,
        is_on=host.is_set,
        tell=notifications.tell,
    )
    recovery = Recovery(
        host.printer,
        link,
        known.machine,
        notifications=notifications,
        is_held=boxes.holds_the_line,
    )
    warnings = WarningList(model, link, guard, recovery=recovery, boxes=boxes, problems=problems)
    file_check = FileCheck(host, link, notifications.tell)
    return Guards(boxes, guard, recovery, warnings, file_check)
