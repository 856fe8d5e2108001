"""OctoPrint's events that the plugin's worker has to know of."""

from octoprint.events import Events

DISABLED_PLUGIN = "plugin_pluginmanager_disable_plugin"
"""The plugin manager's event for a plugin that somebody takes out of use; one that needs a
restart for that isn't told in any other way."""

PRINT_ENDS = (
    Events.PRINT_DONE,
    Events.PRINT_FAILED,
    Events.PRINT_CANCELLED,
)

NOTES = {
    Events.PRINT_PAUSED: "print_paused",
    Events.PRINT_RESUMED: "print_resumed",
    Events.SETTINGS_UPDATED: "settings_updated",
    **dict.fromkeys(PRINT_ENDS, "print_bound"),
    # what its first line has met may have been noted before
    Events.PRINT_STARTED: "print_started",
}
"""Event to the note that it leaves for the worker."""
