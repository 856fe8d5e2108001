"""A plugin that does something deprecated: where that isn't in the log, nobody's would be."""

import warnings

__plugin_name__ = "Old-fashioned"
__plugin_pythoncompat__ = ">=3.9,<4"


def __plugin_enable__():
    warnings.warn("as in the old days", DeprecationWarning, stacklevel=1)
