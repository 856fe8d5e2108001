"""A plugin that listens: ``/api/plugin/eventlistener`` tells the events of others' plugins."""

import flask
import octoprint.plugin

__plugin_name__ = "Event listener"
__plugin_pythoncompat__ = ">=3.9,<4"

PREFIXES = ("DisplayLayerProgress_",)


class EventListener(octoprint.plugin.EventHandlerPlugin, octoprint.plugin.SimpleApiPlugin):
    def __init__(self):
        self._events = []

    def on_event(self, event, payload):
        if event.startswith(PREFIXES):
            self._events.append([event, payload])

    def is_api_protected(self):
        return True

    def on_api_get(self, request):
        return flask.jsonify(events=self._events)


__plugin_implementation__ = EventListener()
