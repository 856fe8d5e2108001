"""OctoPrint's events that the plugin's worker has to know of."""

from octoprint.events import Events

DISABLED_PLUGIN = "plugin_pluginmanager_disable_plugin"
"""The plugin manager's event for a plugin that somebody takes out of use; one that needs a
restart for that isn't told in any other way."""

PRINT_BOUNDS = (
    Events.PRINT_STARTED,
    Events.PRINT_DONE,
    Events.PRINT_FAILED,
    Events.PRINT_CANCELLED,
)
"""Where one print ends or another begins."""

NOTES = {
    Events.PRINT_PAUSED: "print_paused",
    Events.PRINT_RESUMED: "print_resumed",
    Events.SETTINGS_UPDATED: "settings_updated",
    **dict.fromkeys(PRINT_BOUNDS, "print_bound"),
}
"""Event to the note that it leaves for the worker."""
