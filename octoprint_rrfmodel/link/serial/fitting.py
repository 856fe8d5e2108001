"""What of OctoPrint's connection is set for RepRapFirmware as long as it lasts.

None of it is written to OctoPrint's settings.
"""

DIAGNOSTICS = "M122"


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


def begin_a_line(comm):
    """End whatever has been written of a line, so that the next one is read from its beginning.

    Firmware from 3.6.3 on acts on an emergency stop as soon as it reads it, but not behind the
    beginning of another command that it might be (``M1``). An empty line is nothing to any.
    """
    comm._do_send_without_checksum(b"", log=False)
