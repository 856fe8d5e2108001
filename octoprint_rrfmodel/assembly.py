"""Every part of the plugin made once, from the ground up, and who is told of what.

A line comes in by ``link.serial.received`` and goes by the worker and ``link.poller`` to
``rrf.follow.follower``; what it did is told to the listeners, in the order of ``_listeners``. A
command goes by ``control.machine_commands`` or OctoPrint's own operations to
``link.serial.queued``.
"""

import time
from functools import partial

from octoprint.events import Events

from .control.machine_commands import MachineCommands
from .control.rate import Rate
from .guard.guards import make_guards
from .guard.notifications import Notifications
from .host.notes import NOTES
from .host.request_checks import RequestChecks
from .host.setup import Setup
from .host.warnings import worst_first
from .integrations.helpers import Helpers
from .integrations.octoprint_events import MachineEvents
from .integrations.other_plugins import OtherPlugins
from .integrations.plugin_subscribers import PluginSubscribers
from .link.known import Known
from .link.listeners import Listeners
from .link.poller import Poller
from .link.questions import Questions
from .link.reports import TemperatureReports
from .link.serial.display import Display
from .link.serial.patience import Patience
from .link.serial.received import ReceivedLines
from .link.serial.refused_lines import RefusedLines
from .link.serial.sdcard import SdCard
from .link.serial.sdjob import SdJob
from .link.serial.sdupload import UploadRefusal
from .link.serial.sent import SentCommands
from .link.serial.serial_link import SerialLink
from .link.serial.simulated_port import SimulatedPort
from .link.serial.way_out import queued_commands
from .link.status import PluginStatus
from .link.terminal import TerminalFilter
from .link.worker import Worker
from .rrf.card.listing import CardPlan
from .rrf.follow.follower import Follower
from .web.commands_api import PluginCommands
from .web.history_api import MachineHistory
from .web.model_api import ModelApi
from .web.moonraker.moonraker import Moonraker
from .web.push import ModelPush


class Assembly:
    """Makes the parts, floor by floor; ``host`` is OctoPrint (``host.host.Host``)."""

    def __init__(self, host):
        self._host = host
        self._clock = time.monotonic
        self._make_ground()
        self._make_guard()
        self._make_card_and_poller()
        self._make_control()
        self._make_web()
        self._make_integrations()
        self._make_hooks()
        self._listeners.attach(self.listeners())
        self.worker.attach(self.notes(), self._listeners.ticks())

    def _make_ground(self):
        """Make what all else asks: the link, what is known of the machine, the worker."""
        host = self._host
        self.worker = Worker("rrfmodel.worker")
        self._listeners = Listeners()
        self.tell = self._listeners.replied
        self.link = SerialLink(host.printer, host.profiles, self._clock)
        self._follower = Follower()
        self._known = Known(self._follower, self.link, self._clock)
        self.model = self._known.model
        self._reports = TemperatureReports(self._follower, self._known, self._listeners.warmed)
        self._notifications = Notifications(host.tell_pages, self._clock)
        self.setup = Setup(host, self.link, self._known)
        """What the settings page and the first-run wizard show."""

    def _make_guard(self):
        guards = make_guards(
            self._host,
            self.link,
            self._known,
            notifications=self._notifications,
            problems=self.setup.problems,
            clock=self._clock,
        )
        self._boxes, self._guard, self._recovery, self._warnings, self._file_check = guards

    def _make_card_and_poller(self):
        known = self._known
        job = SdJob(known.model, known.is_current, self.link.send, clock=self._clock)
        self._card = SdCard(
            CardPlan(),
            job,
            self.link,
            model=known.model,
            is_reworded=partial(self._host.is_set, "replies"),
        )
        self.link.attach(self._card)
        self._poller = Poller(
            self._follower,
            self._card,
            self.link,
            known=known,
            replied=self._listeners.replied,
            clock=self._clock,
        )

    def _make_control(self):
        self._rate = Rate(self._clock)
        self._commands = MachineCommands(
            self.link,
            self._known.machine,
            self._boxes,
            recovery=self._recovery,
            look=partial(self.worker.notify, "look"),
            rate=self._rate,
        )
        self.questions = Questions(self._poller, self.link)

    def _make_web(self):
        host, model = self._host, self._known.model
        self.status = PluginStatus(
            host.version,
            self.link,
            self._poller,
            known=self._known,
            warnings=self._all_warnings,
            is_first_run=self.setup.is_first_run,
        )
        self.api = ModelApi(model, self.status, self.link)
        self.history = MachineHistory(model, self._poller.is_stale)
        self._push = ModelPush(host.tell_pages, model, self.status, clock=self._clock)
        self.commands = PluginCommands(self._commands, self.setup)
        self.moonraker = Moonraker(
            host,
            self._follower,
            self.link,
            notify=self.worker.notify,
            rate=self._rate,
            clock=self._clock,
        )

    def _make_integrations(self):
        host, model = self._host, self._known.model
        self._events = MachineEvents(host.fire, self._known, self._boxes)
        self._plugin_subscribers = PluginSubscribers(host.plugins, model)
        self.other_plugins = OtherPlugins(
            host,
            self.link,
            model,
            status=self.status,
            command=self._commands.command,
            clock=self._clock,
        )
        self.helpers = Helpers(
            model,
            self._plugin_subscribers.subscribe,
            self.questions,
            command=self._commands.command,
            status=self.status,
            objects=self.moonraker.objects,
        )

    def _make_hooks(self):
        host, notify = self._host, self.worker.notify
        self.display = Display(self.link, self._known, self._poller.is_stale, fire=host.fire)
        self.received = ReceivedLines(
            self.link,
            self._card,
            notify,
            guards=self._guard.handles,
            patience=Patience(self.link, host.silence_minutes, self._boxes.holds_the_line),
            refusals=RefusedLines(self.link, notify, stops=self._guard.stops, clock=self._clock),
        )
        self.queued = queued_commands(
            self.link,
            self._card,
            self._known.machine,
            notify=notify,
            is_on=partial(host.is_set, "operations"),
            prompts=self.other_plugins.prompt.translate,
        )
        self.sent = SentCommands(
            self.link,
            notify,
            self._clock,
            show_target=self.display.show_target,
            sent=self.moonraker.store.sent,
        )
        self.uploads = UploadRefusal(self.link)
        self.terminal = TerminalFilter(host.is_set, self.link)
        self.simulated_port = SimulatedPort(host.simulator)
        self.refusals = [
            self.uploads.refuse,
            self._guard.refuse,
            RequestChecks(self.link).refuse,
            self.commands.refuse,
        ]
        """What looks at requests to OctoPrint's API."""

    def listeners(self):
        """Return who is told, in order; all by the worker's thread.

        The guard comes first: it looks at the model before the poller forgets it, and pauses
        before anybody is shown why. The sockets come last, for then this thread has nothing more
        to do that they would wait for.
        """
        return (
            self._recovery,
            self._boxes,
            self._guard,
            self._file_check,
            self.link,
            self._poller,
            self._push,
            self.other_plugins,
            self._card,
            self.display,
            self.setup.settings,
            self._notifications,
            self.history,
            self.moonraker.objects,
            self._events,
            self._plugin_subscribers,
            self.moonraker.sockets,
        )

    def notes(self):
        """Return what the worker does for each note: name to handler."""
        poller, guard = self._poller, self._guard
        return {
            "identified": self._listeners.identified,
            "disconnected": self._listeners.forgotten,
            "line": self._listeners.line,
            "heard": self._listeners.heard,
            "reply": poller.reply,
            "report": self._reports.take,
            "refused": poller.refused,
            "poll_sent": poller.poll_sent,
            "poll_acknowledged": poller.poll_acknowledged,
            "look": poller.look,
            "send": self.link.send,
            "refused_operation": self._notifications.tell,
            "halted": self._recovery.halted,
            "print_paused": guard.paused,
            "print_resumed": guard.resumed,
            "print_waits": guard.waits_for,
            "print_stops": guard.stopped,
            "print_started": guard.started,
            "print_bound": guard.forgotten,
            "settings_updated": self.setup.settings.look,
        }

    def _all_warnings(self):
        found = self._warnings(), self._file_check.warnings(), self.other_plugins.warnings()
        return worst_first(warning for each in found for warning in each)

    ##~~ OctoPrint's life

    def start(self):
        """Begin to work: OctoPrint is up."""
        self.worker.start()
        self._file_check.start()
        self.other_plugins.start()
        self.moonraker.start()
        self._plugin_subscribers.start()

    def stop(self):
        """End all threads."""
        self._plugin_subscribers.stop()
        self.other_plugins.stop()
        self._file_check.stop()
        self.worker.stop()

    def on_event(self, event, payload):
        """Hand on what OctoPrint says of its connection and its prints."""
        # events come late: by now another connection may be up, which brings its own beginning
        if event == Events.DISCONNECTED and not self.link.is_operational:
            self.link.forget()
            self.worker.notify("disconnected")
        self.moonraker.job.on_event(event, payload)
        self._file_check.on_event(event, payload)
        note = NOTES.get(event)
        if note and self.link.is_rrf:
            self.worker.notify(note)
