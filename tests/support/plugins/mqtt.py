"""Stands in for OctoPrint-MQTT, which is on no package index: the same helper, the same library.

The broker is the one at ``plugins.mqtt.broker.port`` of the loopback address.
"""

import json

import octoprint.plugin
from paho.mqtt import client

__plugin_name__ = "MQTT"
__plugin_pythoncompat__ = ">=3.9,<4"


class Connection:
    """The part of OctoPrint-MQTT that others call; the broker may come and go."""

    def __init__(self):
        self._client = client.Client(client.CallbackAPIVersion.VERSION2)
        self._client.reconnect_delay_set(1, 1)

    def open(self, port):
        """Connect as soon as there is a broker, and again when it was gone."""
        self._client.connect_async("127.0.0.1", port)
        self._client.loop_start()

    def close(self):
        self._client.disconnect()
        self._client.loop_stop()

    @property
    def is_open(self):
        return self._client.is_connected()

    def mqtt_publish(
        self, topic, payload, retained=None, qos=0, allow_queueing=False, raw_data=False
    ):
        """Return whether it goes out; a text goes out as it is, all else as JSON."""
        if not (isinstance(payload, str) or raw_data):
            payload = json.dumps(payload)
        if not self.is_open:
            return False
        self._client.publish(topic, payload, qos=qos, retain=retained is not False)
        return True


class MqttPlugin(
    octoprint.plugin.StartupPlugin, octoprint.plugin.ShutdownPlugin, octoprint.plugin.SettingsPlugin
):
    def __init__(self):
        self.connection = Connection()

    def get_settings_defaults(self):
        return {"broker": {"port": 1883}}

    def on_startup(self, host, port):
        self.connection.open(self._settings.get_int(["broker", "port"]))

    def on_shutdown(self):
        self.connection.close()


def __plugin_load__():
    global __plugin_implementation__, __plugin_helpers__
    __plugin_implementation__ = MqttPlugin()
    __plugin_helpers__ = {"mqtt_publish": __plugin_implementation__.connection.mqtt_publish}
