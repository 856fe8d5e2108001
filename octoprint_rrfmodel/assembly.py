"""The parts of the plugin, put together, and what happens between them.

A line comes in by ``comm`` and goes by the worker and ``polling`` to ``rrf.follower``, whose news
``_on_reply`` hands to all that show them.
"""

import time
from functools import partial

from octoprint.events import Events

from .guard.protection import Protection
from .host.tags import POLL_TAG
from .host.warning_texts import notice_text
from .integrations.helpers import Helpers
from .integrations.other_plugins import Neighbours
from .link.poller import Poller
from .link.serial.comm import CommBridge
from .link.serial.display import Display
from .link.serial.operation_translator import OperationTranslator
from .link.serial.sdcard import SdCard
from .link.serial.sdjob import SdJob
from .link.serial.sdupload import UploadRefusal
from .link.serial.simulated_port import SimulatedPort
from .link.serial.terminal import TerminalFilter
from .link.serial.unsendable_commands import UnsendableCommands
from .link.worker import Worker
from .rrf.card.listing import CardPlan
from .rrf.follow.follower import Follower
from .rrf.views.machine import Machine
from .rrf.views.temperatures import temperatures
from .web.history_api import MachineHistory
from .web.live_api import LiveQuestions
from .web.model_api import ModelApi
from .web.moonraker.interfaces import Interfaces
from .web.push import ModelPush
from .web.status import PluginStatus
from .web.thumbnail_api import Thumbnails


class Parts:
    """Makes the parts and hands on what happens; ``host`` is OctoPrint (``host.Host``)."""

    def __init__(self, host):
        clock = self._clock = time.monotonic
        self._host = host
        self._follower = Follower()
        self.protection = Protection(
            host.printer,
            host.profiles,
            host.settings,
            host.folder,
            lambda: self.bridge,
            self._machine,
            self._notice,
            lambda: self._card.end_job(),
            lambda key: self.worker.notify("look", key),
            lambda: self._follower.ready,
            clock,
        )
        self.worker = Worker(
            {
                "identified": self._on_identified,
                "disconnected": self._on_disconnected,
                "poll_sent": lambda at: self._poller.poll_sent(at),
                "status_sent": lambda: self._poller.status_sent(),
                "reply": lambda text: self._poller.reply(text),
                "refused": lambda line: self._poller.refused(line),
                "refused_operation": self._notice,
                "heard": self._on_heard,
                "said": self._on_said,
                "look": lambda key: self._poller.look(key),
                "send": self._send_lines,
                **self.protection.handlers,
            },
            [
                lambda: self._poller.tick(),
                lambda: self._push.tick(),
                lambda: self.interfaces.tick(),
                lambda: self.history.tick(),
            ],
        )
        refused = partial(self.worker.notify, "refused_operation")
        is_translated = partial(host.is_set, "operations")
        self._operations = OperationTranslator(self._machine, is_translated, refused)
        self._unsendable = UnsendableCommands(
            self._machine, is_translated, refused, partial(self.worker.notify, "print_waits")
        )
        self.display = Display(lambda: self.bridge.connection, self._known_temperatures, host.fire)
        self._card = SdCard(
            CardPlan(),
            SdJob(self._model, self._is_current, lambda line: host.printer().commands(line), clock),
            lambda: self.bridge.connection,
            self._model,
            self._operations.translate,
            partial(host.is_set, "replies"),
        )
        self.bridge = CommBridge(
            self.worker.notify,
            self._translate,
            self._card,
            self.display.show_target,
            self._unsendable.instead,
            self.protection.guard.handles,
            lambda command, tags: self.interfaces.store.sent(command, tags),
            clock,
        )
        self.uploads = UploadRefusal(lambda: self.bridge.is_rrf)
        self._poller = Poller(
            self._follower, self._card, self.bridge, self._send, self._on_reply, clock
        )
        self.history = MachineHistory(self._model, self._poller.is_stale)
        self.status = PluginStatus(
            host.version,
            self.bridge,
            self._poller,
            self._follower,
            lambda: host.printer().is_operational(),
            lambda: [*self.protection.advice(), *self.neighbours.warnings()],
            self.protection.setup.is_first_run,
            clock,
        )
        self.interfaces = Interfaces(
            host,
            self._follower,
            self.bridge,
            self.protection.machine.rate,
            self.worker.notify,
            clock,
        )
        self.neighbours = Neighbours(
            host.plugins,
            host.settings,
            host.printer,
            lambda: self.bridge,
            self._model,
            self.status,
            self.protection.machine.command,
            clock,
        )
        self._push = ModelPush(host.tell_pages, self._model, self.status, clock)
        self.api = ModelApi(self._model, self.status)
        self.questions = LiveQuestions(
            self._poller, self.bridge, self._follower, self.api.why_empty
        )
        self.helpers = Helpers(
            self._model,
            self.interfaces.audience,
            self.questions,
            self.protection.machine.command,
            self.status,
            self.interfaces.objects,
        )
        self.terminal = TerminalFilter(
            lambda: self.bridge.has_polled_at_all() and host.is_set("hide_polls"),
            self.bridge.has_polled,
        )
        self.simulated_port = SimulatedPort(lambda: host.settings().get(["simulator"], merged=True))

    def start(self):
        """Begin to work: OctoPrint is up."""
        self.worker.start()
        self.neighbours.start()
        self.interfaces.start()

    def stop(self):
        """End all threads."""
        self.interfaces.stop()
        self.neighbours.stop()
        self.worker.stop()

    def on_event(self, event, payload):
        """Hand on what OctoPrint says of its connection and its prints."""
        # events come late: by now another connection may be up, which brings its own beginning
        if event == Events.DISCONNECTED and not self._host.printer().is_operational():
            self.bridge.forget()
            self.worker.notify("disconnected")
        self.interfaces.on_event(event, payload)
        note = self.protection.note_of(event)
        if note and self.bridge.is_rrf:
            self.worker.notify(note)

    def on_firmware_info(self, comm, firmware_name, data, *args, **kwargs):
        """Keep what the firmware says of itself, and find out whether it is RepRapFirmware."""
        self.status.reported(data)
        self.bridge.on_firmware_info(comm, firmware_name, data)

    def thumbnails(self):
        """Return what fetches pictures, for Tornado's loop."""
        return Thumbnails(self.questions, self._model)

    ##~~ what the parts ask of each other

    def _model(self):
        return self._follower.store.model

    def _is_current(self):
        return self._poller.asked_at > self.bridge.settled_at and not self._follower.behind

    def _machine(self):
        return Machine(self._model(), self._is_current())

    def _known_temperatures(self):
        model = self._model()
        known = temperatures(model) if "heat" in model else None
        knows_targets = self._poller.asked_at > self.bridge.target_command_at
        return known, not self._poller.is_stale(), knows_targets

    def _translate(self, cmd, gcode, tags):
        answer = self.neighbours.translate(cmd, gcode)
        return answer or self._card.translate(cmd, gcode, tags)

    def _send(self, line):
        self._host.printer().commands(line, tags={POLL_TAG})

    def _send_lines(self, lines, tags, force):
        self._host.printer().commands(lines, tags=tags, force=force)

    def _notice(self, code, detail):
        text = notice_text(code, detail)
        notice = {"type": "notice", "code": code, "detail": detail, "text": text}
        self._host.tell_pages({**notice, "at": round(self._clock(), 3)})

    ##~~ on the worker

    def _on_reply(self, taken, asked_at):
        self._show(taken, asked_at)
        self.history.replied()
        # last, for then this thread has nothing more to do that sockets would wait for
        self.interfaces.replied(taken)

    def _on_said(self, line):
        self.history.heard(line)
        self.interfaces.heard(line)

    def _show(self, taken, asked_at):
        if taken.reset:
            self._push.forgotten()
            self.neighbours.forgotten()
            self.protection.guard.board_was_reset()
            self._notice("board_reset", "")
            return
        self._push.changed(taken.changes)
        self.neighbours.changed(taken.changes)
        self._card.on_news()
        tool = self._model().get("state", {}).get("currentTool")
        # what was asked for before OctoPrint's own last tool command says nothing about it
        if isinstance(tool, int) and self._poller.asked_at > self.bridge.tool_command_at:
            self.display.follow_tool(tool)
        self.protection.replied(asked_at)

    def _on_heard(self, what):
        if what == "card":
            self._poller.card_refused()
            return
        self.protection.heard(what)
        self._poller.hurry()

    def _on_identified(self):
        self._on_disconnected()
        self._card.identified()
        self.protection.identified()
        self._poller.start()

    def _on_disconnected(self):
        self.protection.disconnecting()
        self._poller.stop()
        self._push.forgotten()
        self.history.forgotten()
        self.interfaces.forgotten()
        self.neighbours.forgotten()
