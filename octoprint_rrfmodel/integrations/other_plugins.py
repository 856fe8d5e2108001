"""Other plugins that this one serves without being asked, put together.

What they do may take its time, and they are called on a thread of their own: neither polls nor
pages wait for a broker.
"""

from octoprint.access.permissions import Permissions
from octoprint.events import eventManager

from ..guard.warning_list import warning
from ..link.worker import Worker
from . import psu
from .box_prompt import BoxPrompt, handler_of
from .layer_progress import PLUGIN as DISPLAY_LAYER_PROGRESS
from .layer_progress import LayerProgress, streamed_print
from .mqtt import MqttPublisher, mqtt_publish


class Neighbours:
    """MQTT, PSUControl, DisplayLayerProgress's readers, and OctoPrint's dialog for prompts.

    ``plugins()``, ``settings()`` and ``printer()`` are OctoPrint's, ``bridge()`` knows the
    connection, ``model()`` is the snapshot, ``status()`` the plugin's state. ``command(name,
    **parameters)`` queues a command or raises ``ValueError``.
    """

    def __init__(self, plugins, settings, printer, bridge, model, status, command, clock):
        self._plugins = plugins
        self._settings = settings
        self._printer = printer
        self._bridge = bridge
        self._supply = psu.PowerSupply(command, model)
        self._mqtt = MqttPublisher(
            lambda: mqtt_publish(plugins()), self._topic, model, status, clock
        )
        self._layers = LayerProgress(
            self._tell_readers,
            lambda event, payload: eventManager().fire(event, payload),
            model,
            self._streamed,
            self._wants_layers,
            clock,
        )
        self._prompt = BoxPrompt(
            handler_of(plugins),
            lambda: bridge().connection,
            model,
            lambda: settings().get_boolean(["prompts"]),
        )
        self._worker = Worker(
            {"look": self._prompt.look}, [self._mqtt.tick, self._layers.tick], "rrfmodel.neighbours"
        )

    def register(self, plugin):
        """Make the plugin known where others have to know it; all plugins are loaded by now."""
        psu.register(self._plugins(), plugin, self._supply)

    def start(self):
        """Begin to serve."""
        self._worker.start()

    def stop(self):
        """Serve no more."""
        self._worker.stop()

    def changed(self, keys):
        """Note top-level keys of the model that changed; any thread may."""
        self._mqtt.changed(keys)
        if "state" in keys:
            self._worker.notify("look")

    def forgotten(self):
        """Note that the model was emptied; any thread may."""
        self._mqtt.forgotten()
        self._worker.notify("look")

    def translate(self, cmd, gcode):
        """Return what goes out in place of an answer to a prompt, ``None`` for other commands."""
        return self._prompt.translate(cmd, gcode)

    def warnings(self):
        """Return what a person should change, in the form of the plugin's state."""
        code = self._mqtt.problem()
        return [warning(code)] if code else []

    def _topic(self):
        is_on = self._settings().get_boolean(["mqtt", "enabled"])
        return (self._settings().get(["mqtt", "topic"]) or "") if is_on else None

    def _tell_readers(self, message, payload):
        self._plugins().send_plugin_message(
            message, payload, permissions=[Permissions.PLUGIN_RRFMODEL_READ]
        )

    def _streamed(self):
        if not self._bridge().has_a_print():
            return None
        return streamed_print(self._printer().get_current_data())

    def _wants_layers(self):
        # the plugin itself knows better what it wants to say
        is_absent = self._plugins().get_plugin_info(DISPLAY_LAYER_PROGRESS) is None
        return is_absent and self._settings().get_boolean(["layer_progress"])
