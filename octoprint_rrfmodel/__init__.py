"""What OctoPrint reads to load the plugin; the plugin itself is in ``plugin``.

Importing ``octoprint_rrfmodel.rrf`` executes this file too, and that package works without
OctoPrint: nothing but literals may stand at module level.
"""

__plugin_name__ = "RepRapFirmware Model"
__plugin_pythoncompat__ = ">=3.9,<4"


def __plugin_load__():
    """Build the plugin and hand OctoPrint its implementation, hooks and helpers."""
    from .hooks import hooks_of
    from .plugin import RrfModelPlugin

    global __plugin_implementation__, __plugin_hooks__, __plugin_helpers__
    __plugin_implementation__ = RrfModelPlugin()
    __plugin_hooks__ = hooks_of(__plugin_implementation__)
    __plugin_helpers__ = __plugin_implementation__.parts.helpers.by_name()
