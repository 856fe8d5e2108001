"""Which OctoPrint this is, where the two differ."""

from octoprint.util.version import is_octoprint_compatible

IS_2 = is_octoprint_compatible(">=2.0.0rc1")
"""Whether this is OctoPrint 2.0 or newer."""
