"""What of OctoPrint's connection is set for as long as it lasts: for RepRapFirmware, for others.

None of it is written to OctoPrint's settings.
"""

DIAGNOSTICS = "M122"

OWN = "rrfmodel"
"""The plugin's name among those whose hooks a connection calls."""

_LEFT = "_rrfmodel_left"


def fit(comm):
    """Let a connection send what the board is to get, in the form that does no harm there."""
    # the board knows its tools, whatever number of extruders the printer profile has: a file's T1
    # that vanishes is a print with the wrong tool
    comm._sanity_check_tools = False
    # firmware from 3.6.3 on looks out for a line that begins with M122 before it queues it, and
    # then deletes all that waits in the input; behind a line number it comes in its turn
    numbered = getattr(comm, "_checksum_requiring_commands", None) or ()
    if DIAGNOSTICS not in numbered:
        comm._checksum_requiring_commands = [*numbered, DIAGNOSTICS]


def leave_alone(comm):
    """Have OctoPrint ask the plugin about no line of a connection: it isn't RepRapFirmware's.

    Each connection has its own mappings of hooks. They are replaced, not changed: other threads
    may be going through them.
    """
    received = getattr(comm, "_received_message_hooks", None)
    phases = getattr(comm, "_gcode_hooks", None)
    if received is None or phases is None or hasattr(comm, _LEFT):
        return
    setattr(comm, _LEFT, (received, phases))
    comm._received_message_hooks = _without_own(received)
    comm._gcode_hooks = {phase: _without_own(hooks) for phase, hooks in phases.items()}


def look_again(comm):
    """Undo ``leave_alone``: what told something else before is RepRapFirmware after all."""
    left = getattr(comm, _LEFT, None)
    if left is not None:
        comm._received_message_hooks, comm._gcode_hooks = left
        delattr(comm, _LEFT)


def _without_own(hooks):
    return {name: hook for name, hook in hooks.items() if name != OWN}


def begin_a_line(comm):
    """End whatever has been written of a line, so that the next one is read from its beginning.

    Firmware from 3.6.3 on acts on an emergency stop as soon as it reads it, but not behind the
    beginning of another command that it might be (``M1``). An empty line is nothing to any.
    """
    comm._do_send_without_checksum(b"", log=False)
