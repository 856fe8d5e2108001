"""Stands in for DisplayLayerProgress, which is on no package index: it is there, and no more."""

import octoprint.plugin

__plugin_name__ = "DisplayLayerProgress"
__plugin_pythoncompat__ = ">=3.9,<4"
__plugin_implementation__ = octoprint.plugin.OctoPrintPlugin()
