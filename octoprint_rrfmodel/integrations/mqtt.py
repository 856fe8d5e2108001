"""The model for other machines, through OctoPrint-MQTT where that plugin is present.

Below the topic of the settings, as retained JSON:

* ``<topic>/<key>``: each top-level key of the object model, whole, when it has changed.
* ``<topic>/status``: the plugin's state without what changes all the time. Values stay with the
  broker when the printer is gone: ``ready`` and ``stale`` say whether they still hold.
"""

import json
import logging
import threading

from ..link.status import UNIMPORTANT

SHORTEST_SECONDS = 1.0

STATUS = "status"
"""The last part of the topic of the plugin's state; no key of the object model is called so."""

MOST_BYTES = 1024
"""How long a topic may be; MQTT's own limit is 65,535 with the key."""

WILDCARDS = frozenset("+#")


def mqtt_publish(plugin_manager):
    """Return OctoPrint-MQTT's helper that publishes, ``None`` where that plugin isn't in use.

    It is called ``(topic, payload, retained=None)``, sends a text as it is, never waits, and
    returns False while there is no connection to the broker (OctoPrint-MQTT 0.8).
    """
    helpers = plugin_manager.get_helpers("mqtt", "mqtt_publish")
    return (helpers or {}).get("mqtt_publish")


def topic_of(text):
    """Return the topic that a setting means, without slashes at its end.

    ``None`` for what MQTT takes for no topic to publish to: an empty one, one with a wildcard,
    with control characters, or too long.
    """
    topic = str(text or "").strip().rstrip("/")
    if not topic or not topic.isprintable() or WILDCARDS & set(topic):
        return None
    return topic if len(topic.encode()) <= MOST_BYTES else None


class MqttPublisher:
    """Publishes what has changed, at most once a second.

    ``publish()`` is the helper or ``None``, ``topic()`` the setting, ``None`` where publishing is
    switched off. ``model()`` is the snapshot, ``status()`` the plugin's state. ``changed`` and
    ``forgotten`` may be called by any thread, ``tick`` by one. None of them raises because of the
    broker.
    """

    def __init__(self, publish, topic, model, *, status, clock):
        self._publish = publish
        self._topic = topic
        self._model = model
        self._status = status
        self._clock = clock
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.mqtt")
        self._lock = threading.Lock()
        self._changed = set()
        self._base = None
        self._published = set()
        self._told = None
        self._lacks_all = True
        self._complained = None
        self._looked_at = None

    def changed(self, keys):
        """Note top-level keys that changed."""
        with self._lock:
            self._changed.update(keys)

    def forgotten(self):
        """Note that the model was emptied: nothing of it goes out any more."""
        with self._lock:
            self._changed.clear()

    def publishes(self):
        """Return whether anything goes out."""
        return self._base is not None

    def problem(self):
        """Return the code of a warning where the setting is no topic and somebody publishes."""
        # it is asked often, and hardly anybody has a publisher
        if self._publish() is None:
            return None
        setting = self._topic()
        return None if setting is None or topic_of(setting) else "mqtt_topic"

    def tick(self):
        """Publish what is due; return the seconds until something may be."""
        now = self._clock()
        if self._looked_at is not None and now < self._looked_at + SHORTEST_SECONDS:
            return self._looked_at + SHORTEST_SECONDS - now
        self._looked_at = now
        publish = self._publish()
        if publish is None:
            # a broker that is there later has to be told everything
            self._lacks_all = True
            return SHORTEST_SECONDS
        self._move_to(publish, self._topic())
        if self._base is not None:
            self._publish_changes(publish)
        return SHORTEST_SECONDS

    def _move_to(self, publish, setting):
        """Go on below the topic of the settings; what lies below another one is taken back."""
        base = topic_of(setting)
        if setting is not None and base is None:
            self._complain("%r is no topic, so nothing is published", setting)
        if base == self._base:
            return
        for topic in self._published:
            # an empty retained message deletes the one that the broker keeps
            self._send(publish, topic, "")
        self._published = set()
        self._base = base
        self._lacks_all = True

    def _publish_changes(self, publish):
        with self._lock:
            changed, self._changed = self._changed, set()
        model = self._model()
        parts = [(key, model[key]) for key in sorted(model) if self._lacks_all or key in changed]
        status = {name: value for name, value in self._status().items() if name not in UNIMPORTANT}
        if self._lacks_all or status != self._told:
            # who hears that the values hold finds them there, and the other way round
            place = len(parts) if status["ready"] else 0
            parts.insert(place, (STATUS, status))
        for name, value in parts:
            if not name.isidentifier():
                # a broken byte in a reply is no reason for a topic of its own
                continue
            topic = f"{self._base}/{name}"
            if not self._send(publish, topic, json.dumps(value, separators=(",", ":"))):
                self._lacks_all = True
                return
            self._published.add(topic)
        if parts:
            self._complained = None
        self._told = status
        self._lacks_all = False

    def _send(self, publish, topic, payload):
        try:
            if publish(topic, payload, retained=True):
                return True
            self._complain("OctoPrint-MQTT has no connection to its broker")
        except Exception as error:
            self._complain("Could not publish: %s", error)
        return False

    def _complain(self, message, *arguments):
        """Log a thing once, until something was published again."""
        if self._complained != message:
            self._complained = message
            self._logger.warning(message, *arguments)
