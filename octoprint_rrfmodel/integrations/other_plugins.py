"""Other plugins that this one serves without being asked, put together.

What they do may take its time, and they are called on a thread of their own: neither polls nor
pages wait for a broker.
"""

from octoprint.access.permissions import Permissions

from ..host.warnings import warning
from ..link.worker import Worker
from . import psu
from .box_prompt import BoxPrompt, handler_of
from .layer_progress import PLUGIN as DISPLAY_LAYER_PROGRESS
from .layer_progress import LayerProgress, Readers, streamed_print
from .mqtt import MqttPublisher, mqtt_publish


class OtherPlugins:
    """MQTT, PSUControl, DisplayLayerProgress's readers, and OctoPrint's dialog for prompts.

    ``host`` is OctoPrint (``host.Host``), ``link`` leads to the board, ``model()`` is the
    snapshot, ``status()`` the plugin's state. ``command(name, **parameters)`` queues a command or
    raises ``ValueError``.
    """

    def __init__(self, host, link, model, *, status, command, clock):
        self._host = host
        self._link = link
        self._supply = psu.PowerSupply(command, model)
        self._mqtt = MqttPublisher(
            self._mqtt_publish, self._topic, model, status=status, clock=clock
        )
        self._layers = LayerProgress(
            Readers(self._tell_readers, host.fire),
            model,
            self._streamed,
            is_wanted=self._wants_layers,
            clock=clock,
        )
        self.prompt = BoxPrompt(
            handler_of(host.plugins), link, model=model, is_on=self._wants_prompts
        )
        """Also looks at commands in the queuing hook."""
        self.publishes = self._mqtt.publishes
        self._worker = Worker("rrfmodel.other_plugins")
        self._worker.attach({"look": self.prompt.look}, [self._mqtt.tick, self._layers.tick])

    def register(self, plugin):
        """Make the plugin known where others have to know it; all plugins are loaded by now."""
        psu.register(self._host.plugins(), plugin, self._supply)

    def start(self):
        """Begin to serve."""
        self._worker.start()

    def stop(self):
        """Serve no more."""
        self._worker.stop()

    def warnings(self):
        """Return what a person should change, in the form of the plugin's state."""
        code = self._mqtt.problem()
        return [warning(code)] if code else []

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Note top-level keys of the model that changed."""
        self._mqtt.changed(taken.changes)
        if "state" in taken.changes:
            self._worker.notify("look")

    def warmed(self, warmed):
        """Note temperatures that a line has told."""
        self._mqtt.changed(warmed.changes)

    def reset(self):
        """Note that the model was emptied."""
        self.forgotten()

    def forgotten(self):
        """Note that the model was emptied."""
        self._mqtt.forgotten()
        self._worker.notify("look")

    ##~~ what the parts ask

    def _mqtt_publish(self):
        return mqtt_publish(self._host.plugins())

    def _topic(self):
        is_on = self._host.is_set("mqtt", "enabled")
        return (self._host.settings().get(["mqtt", "topic"]) or "") if is_on else None

    def _tell_readers(self, message, payload):
        self._host.plugins().send_plugin_message(
            message, payload, permissions=[Permissions.PLUGIN_RRFMODEL_READ]
        )

    def _streamed(self):
        if not self._link.has_a_print():
            return None
        return streamed_print(self._host.printer().get_current_data())

    def _wants_layers(self):
        # the plugin itself knows better what it wants to say
        is_absent = self._host.plugins().get_plugin_info(DISPLAY_LAYER_PROGRESS) is None
        return is_absent and self._host.is_set("layer_progress")

    def _wants_prompts(self):
        return self._host.is_set("prompts")
