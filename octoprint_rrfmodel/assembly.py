"""Every part of the plugin made once, from the ground up, and who is told of what.

A line comes in by ``link.serial.received`` and goes by the worker and ``link.poller`` to
``rrf.follow.follower``; what it did is told to the listeners, in the order of ``_listeners``.
"""

import time
from functools import partial

from octoprint.events import Events

from .control.machine_commands import MachineCommands
from .control.rate import Rate
from .guard.guards import make_guards
from .guard.notifications import Notifications
from .host.notes import NOTES
from .host.own_log import OwnLog
from .host.request_checks import RequestChecks
from .host.setup import Setup
from .host.version import IS_2
from .host.warnings import worst_first
from .integrations.helpers import Helpers
from .integrations.octoprint_events import MachineEvents
from .integrations.other_plugins import OtherPlugins
from .integrations.plugin_subscribers import PluginSubscribers
from .link.exchanges import Exchanges
from .link.followed import make_follower
from .link.heater_ages import HeaterAges
from .link.known import Known
from .link.last_simulation import LastSimulation
from .link.links import Links
from .link.listeners import Listeners
from .link.network.beside import Beside
from .link.network.beside_files import BesideFiles, FilesInUse
from .link.network.network import Network
from .link.poller import Poller
from .link.questions import Questions
from .link.reports import BoxReports, TemperatureReports
from .link.resets import Resets
from .link.sender import Sender
from .link.serial.hooks_made import serial_hooks
from .link.serial.sdcard import SdCard
from .link.serial.sdjob import SdJob
from .link.serial.serial_link import SerialLink
from .link.status import PluginStatus
from .link.worker import Worker
from .rrf.card.listing import CardPlan
from .web.audience import Audience
from .web.commands_api import PluginCommands
from .web.console_api import Console
from .web.history_api import MachineHistory
from .web.model_api import ModelApi
from .web.moonraker.moonraker import Moonraker, Parts
from .web.network_api import NetworkRequests
from .web.pages import Pages
from .web.prints import Prints
from .web.push import ModelPush
from .web.support_bundle import Heard, SupportBundle


class Assembly:
    """Makes the parts, floor by floor; ``host`` is OctoPrint (``host.host.Host``)."""

    def __init__(self, host):
        self._host, self._clock = host, time.monotonic
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
        self._sender = Sender()
        later, notify = self._sender.later, self.worker.notify
        self.link = SerialLink(host.printer, host.profiles, self._clock, later=later, notify=notify)
        self._links = Links(self.link)
        self._interest, self._follower = make_follower(self._clock)
        self._known = Known(self._follower, self._links, self._clock)
        self.model = self._known.model
        self._reports = TemperatureReports(self._follower, self._known, self._listeners.warmed)
        self._heater_ages, self._simulation = HeaterAges(self._clock), LastSimulation(self.model)
        self._pages = Pages(host.tell_pages, lambda: host.plugins().registered_clients)
        self._notifications = Notifications(self._pages.tell, self._clock)
        self.setup = Setup(host, self._links, self._known)

    def _make_guard(self):
        guards = make_guards(
            self._host,
            self._links,
            self._known,
            notifications=self._notifications,
            problems=self.setup.problems,
            show_box=BoxReports(self._follower, self.tell).show,
            clock=self._clock,
        )
        self._boxes, self._guard, self._recovery, self._warnings, self._file_check = guards

    def _make_card_and_poller(self):
        known = self._known
        job = SdJob(known.model, known.is_current, self.link.send_later, clock=self._clock)
        reworded = partial(self._host.is_set, "replies")
        self._card = SdCard(CardPlan(), job, self.link, model=known.model, is_reworded=reworded)
        self.link.attach(self._card)
        self._poller = Poller(
            self._follower,
            self._card,
            self._links,
            known=known,
            replied=self._listeners.replied,
            clock=self._clock,
        )

    def _make_control(self):
        self._commands = MachineCommands(
            self._links,
            self._known.machine,
            self._boxes,
            recovery=self._recovery,
            look=partial(self.worker.notify, "look"),
            rate=Rate(self._clock),
        )
        self.questions = Questions(self._poller, self._links)

    def _make_web(self):
        host, model, known = self._host, self._known.model, self._known
        # what is made below is asked only later
        self.prints = Prints(host, model, self._links, sent=lambda: self.moonraker.job.job())
        told = {"warnings": self._all_warnings, "is_first_run": self.setup.is_first_run}
        notes = {"notify": self.worker.notify, "clock": self._clock}
        self.beside = Beside(host.settings, self._links, known, **notes)
        self.link.beside = BesideFiles(self.beside, model, host.folder, clock=self._clock)
        told.update(heater_ages=self._heater_ages, simulated_file=self._simulation)
        told.update(self.prints.told, beside=self.beside.is_found)
        self.status = PluginStatus(host.version, self._links, self._poller, known=known, **told)
        samples = lambda time: self.history.samples(time)  # noqa: E731
        parts = Parts(self._commands, samples, self.prints.jobs)
        self.moonraker = Moonraker(host, self._follower, self._links, parts=parts, **notes)
        subscribers = self._plugin_subscribers = PluginSubscribers(host.plugins, model)
        self._audience = Audience(self._interest, self.moonraker.sockets.count, subscribers.paths)
        self.api = ModelApi(model, self.status, self._links, audience=self._audience)
        looks = {"audience": self._audience, "streamed": self.prints.layers}
        self.history = MachineHistory(model, self._poller.is_stale, **looks)
        self.console = Console(self.moonraker.store, self._pages, self._clock)
        follows = {"follower": self._follower, "clock": self._clock}
        self._push = ModelPush(self._pages, model, self.status, **follows)
        sent = self.moonraker.store.sent
        self.networks = tuple(
            Network(self._links, host, known=known, sent=sent, **notes) for _ in range(IS_2)
        )
        """What boards on the network stand on; none in 1.11."""
        self.machine_files = FilesInUse(self._links, self.networks, self.link.beside)
        self._network_requests = [NetworkRequests(each.memory) for each in self.networks]
        more = {name: run for each in self._network_requests for name, run in each.commands()}
        self.commands = PluginCommands(self._commands, self.setup, more=more)
        self._exchanges = Exchanges(self._poller, self._clock)
        heard = Heard(self._exchanges, self.moonraker.store, OwnLog())
        table = self.setup.settings.table
        about = {"link": self._links, "octoprint_settings": table, "heard": heard}
        self.bundle = SupportBundle(host, self.status, model, **about)

    def _make_integrations(self):
        host, model = self._host, self._known.model
        self._events = MachineEvents(host.fire, self._known, self._boxes)
        does = {"status": self.status, "command": self._commands.command}
        self.other_plugins = OtherPlugins(host, self._links, model, **does, clock=self._clock)
        self._audience.publishes = self.other_plugins.publishes
        subscribe, objects = self._plugin_subscribers.subscribe, self.moonraker.objects
        self.helpers = Helpers(model, subscribe, self.questions, **does, objects=objects)

    def _make_hooks(self):
        hooks = serial_hooks(
            self._host,
            self.link,
            self._card,
            known=self._known,
            notify=self.worker.notify,
            clock=self._clock,
            guard=self._guard,
            is_stale=self._poller.is_stale,
            waits_for_a_person=self._boxes.wait_for_a_person,
            sent=self.moonraker.store.sent,
            prompts=self.other_plugins.prompt.translate,
        )
        self.display, self.received, self.queued, self.sent = hooks[:4]
        self.uploads, self.terminal, self.simulated_port = hooks[4:]
        self.refusals = [
            self.uploads.refuse,
            self._guard.refuse,
            RequestChecks(self._links).refuse,
            self.commands.refuse,
            *(each.refuse for each in self._network_requests),
        ]

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
            *(self.link, self.beside, self.link.beside, *self.networks),
            *(self._poller, self._heater_ages, self._simulation),
            self.prints.jobs,
            self._push,
            self.console,
            self.other_plugins,
            self._card,
            self.display,
            self.setup,
            self._notifications,
            self.history,
            self.moonraker.objects,
            self._events,
            self._plugin_subscribers,
            self._audience,
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
            "reply": self._exchanges.reply,
            "report": self._reports.take,
            "refused": self._exchanges.refused,
            "poll_sent": self._exchanges.poll_sent,
            "poll_acknowledged": poller.poll_acknowledged,
            "look": poller.look,
            "was_reset": Resets(self._follower, poller, self._listeners).note,
            "refused_operation": self._notifications.tell,
            "halted": self._listeners.halted,
            "print_paused": guard.paused,
            "print_resumed": guard.resumed,
            "print_waits": guard.waits_for,
            "print_stops": guard.stopped,
            "print_started": guard.started,
            "print_bound": guard.forgotten,
            "settings_updated": self.setup.look,
        }

    def _all_warnings(self):
        found = self._warnings(), self._file_check.warnings(), self.other_plugins.warnings()
        return worst_first(warning for each in found for warning in each)

    ##~~ OctoPrint's life

    def start(self):
        """Begin to work: OctoPrint is up."""
        for part in self._threads():
            part.start()

    def stop(self):
        """End all threads, and leave what was listened to."""
        for part in reversed(self._threads()):
            part.stop()

    def _threads(self):
        own = self.bundle, self._pages, self._sender, self.prints, self.worker, self._file_check
        others = self.other_plugins, self._plugin_subscribers, self.moonraker
        return (*own, *self.networks, *others)

    def on_event(self, event, payload):
        """Hand on what OctoPrint says of its connection and its prints."""
        # events come late: by now another connection may be up, which brings its own beginning
        is_line = self._links.current is self.link
        if event == Events.DISCONNECTED and is_line and not self.link.is_operational:
            self.link.forget()
            self.worker.notify("disconnected")
        if not is_line and event != Events.SETTINGS_UPDATED:
            # a print that the board runs by itself is nothing to who looks after a streamed one
            return
        for part in (self.moonraker, self._file_check, self.prints):
            part.on_event(event, payload)
        note = NOTES.get(event)
        if note and self._links.is_rrf:
            self.worker.notify(note)
