"""Tags by which commands are told apart in OctoPrint's queue and in its log."""

FILE_TAG = "source:file"
"""OctoPrint's own, of the lines of a print."""

POLL_TAG = "trigger:rrfmodel.poll"
POLL_TYPE = "rrfmodel_poll"

STATUS_TAG = "trigger:rrfmodel.status"
"""Of the M105 in front of a command that blocks."""

COMMAND_TAG = "trigger:rrfmodel.command"

SCRIPT_TAG = "trigger:rrfmodel.script"

SWALLOWED = "// rrfmodel"
"""Stands for a line that was ours: counts as a sign of life and is parsed no further."""
