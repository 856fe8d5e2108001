"""A board on the network as a link; whoever else asks gets what it has from the exchange."""

import logging

from ...rrf.gcode.doing import what_of
from ...rrf.wire.heard import heard
from ...rrf.wire.masking import masked
from ...rrf.wire.rr import LONGEST_LINE
from ..link import Doing, Link
from .exchange import Exchange
from .height_maps import HeightMaps
from .news import TOLD, News
from .outgoing import Command
from .ration import Ration
from .stop import stop
from .under_way import UnderWay, gcode_of
from .up_time import UpTime

UNREACHABLE = "unreachable"
"""Why no poll goes out while the board doesn't answer."""

OF_A_LINE = frozenset(("card", "silence", "box"))
"""What a text tells of a serial line alone: here the model says it, and sooner."""

RECONNECTED_SECONDS = 90.0


class NetworkLink(Link):
    """Knows the exchange with a board from its greeting to its end.

    ``notify(name, *arguments)`` only takes note. ``model()`` is the snapshot. OctoPrint's
    printer is told through ``printer``, ``nobody`` where there is none.
    """

    kind = "network"

    def __init__(self, notify, clock, *, model, patience, nobody, sent):
        self._notify = notify
        self._clock = clock
        self._patience = patience
        self._nobody = nobody
        self._sent = sent
        self._model = model
        self._under_way = UnderWay(model, clock)
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.network")
        self._ups = 0
        self._up_time = UpTime()
        self.exchange = None
        self.printer = nobody
        """What of OctoPrint's stands for the board."""
        self.heights = HeightMaps(self, model)

    ##~~ from one connection to the next

    def open(self, printer, session):
        """Begin to talk with a board for a printer of OctoPrint's."""
        self.close()
        self.printer = printer
        news = News(**{name: self._of(printer, name) for name in TOLD})
        rules = {"patience": self._patience, "ration": Ration(self._clock)}
        self.exchange = Exchange(session, news, self._clock, **rules)
        self.exchange.start()

    def close(self):
        """Talk with the board no more; what comes from it is nobody's from now on."""
        exchange, self.exchange = self.exchange, None
        self.printer = self._nobody
        if exchange is not None:
            exchange.close()
        self.forget()

    def _of(self, printer, name):
        """Return what is called with news, as long as it is about this printer."""
        take = getattr(self, f"_{name}_news")

        def told(*arguments):
            if printer is self.printer:
                take(*arguments)

        return told

    ##~~ news from the exchange, on its thread

    def _greeted_news(self, greeting):
        self.connection = self.exchange
        self._notify("identified")
        self.printer.greeted(greeting)

    def _polled_news(self, request, asked_at, text):
        self._notify("poll_sent", asked_at)
        if text is None:
            self._notify("refused", f"{request.line.split()[0]}: unsupported")
        else:
            self._notify("reply", text)
            self._notify("poll_acknowledged")

    def _sent_news(self, line):
        self._under_way.sent(line)
        self._sent(line, getattr(line, "tags", ()))
        self.printer.log(f">>> {masked(line)}")
        self._notify("look")

    def _done_news(self, line):
        self._under_way.done(line)
        self._notify("look")

    def _said_news(self, text):
        for line in filter(None, map(str.rstrip, text.splitlines())):
            self.printer.log(f"<<< {line}")
            told = heard(line)
            if told and told not in OF_A_LINE:
                self._notify("heard", told)
            self._notify("line", line)
            self.printer.heard(line)

    def _unsent_news(self, line, why):
        self.printer.log(f"!!! not sent ({why}): {masked(line)}")
        if why != "stopped":
            self._notify("refused_operation", f"unsent_{why}", line)

    def _away_news(self, why):
        self.printer.log(f"--- the board doesn't answer: {why}")

    def _back_news(self, up_time, asked_at):
        self.printer.log("--- the board answers again")
        if self._up_time.has_gone_back(up_time, asked_at):
            self._notify("was_reset")
        self._lost_news()

    def _lost_news(self):
        # whatever was known may be another board's by now
        self._notify("look", "")

    def _ended_news(self, code, why):
        self.printer.ended(code, why)

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Look what a reply says of the command that is under way."""
        if (exchange := self.exchange) is None:
            return
        self._under_way.replied(asked_at, exchange.dialect)
        self.heights.look()
        self._up_time.note(self._model(), asked_at)

    def reset(self):
        """Know of no command: the board began anew."""
        self._ups += 1
        self._up_time.forget()
        self._under_way.forget()
        if (exchange := self.exchange) is not None:
            exchange.drop("reset")

    ##~~ Link

    @property
    def is_operational(self):
        return self.connection is not None

    @property
    def protocol(self):
        return exchange.dialect.protocol if (exchange := self.exchange) is not None else None

    @property
    def settled_at(self):
        return self._under_way.settled_at

    @property
    def target_command_at(self):
        return self._under_way.target_command_at

    @property
    def tool_command_at(self):
        return self._under_way.tool_command_at

    @property
    def is_away(self):
        return (exchange := self.exchange) is not None and exchange.is_away

    @property
    def height_map(self):
        return self.heights.known

    def read_height_map(self):
        return self.heights.read()

    def forget(self):
        self.connection = None
        self.heights.forget()
        self._up_time.forget()
        self._under_way.forget()

    def ask(self, request):
        if (exchange := self.exchange) is not None:
            exchange.ask(request)

    def give_up(self):
        if (exchange := self.exchange) is not None:
            exchange.give_up()

    def send(self, lines, tags, force=False):
        ordered = reversed(lines) if force else lines
        for line in [each for text in ordered for each in text.splitlines()]:
            self._send(line.strip(), tags, force)

    def _send(self, line, tags, first):
        if not line or line.startswith((";", "@")) or (exchange := self.exchange) is None:
            return
        gcode = gcode_of(line)
        if gcode == "M112":
            self.stop_now(())
        elif len(line.encode()) > LONGEST_LINE:
            self._unsent_news(line, "too_long")
        else:
            # without anything behind it, it would empty the board's input
            text = f"{line} " if line.upper() == "M122" else line
            exchange.send(Command.of(text, tags), first)

    def send_later(self, lines, tags):
        self.send(lines, tags)

    def carried(self, lines, machine):
        return list(lines)

    def stop_now(self, tags):
        if (exchange := self.exchange) is not None:
            exchange.drop("stopped")
            stop(exchange.dialect, self._logger)

    @property
    def can_restart(self):
        return self.exchange is not None

    def restart(self, is_running):
        if is_running() or (exchange := self.exchange) is None:
            return
        exchange.drop("reset")
        before = self._ups
        stop(exchange.dialect, self._logger, "M999")
        self._wait_for(lambda: self._ups != before)
        self._logger.info("The board was restarted and is there again")

    def _wait_for(self, condition):
        exchange, end = self.exchange, self._clock() + RECONNECTED_SECONDS
        while not condition():
            if self.exchange is not exchange:
                return
            if self._clock() > end:
                raise TimeoutError("the board did not come back")
            exchange.pause(0.2)

    def reconnect(self):
        self.printer.reconnect()

    def blocked(self):
        return UNREACHABLE if self.is_away else None

    def doing(self):
        last = self._under_way.last
        if self.connection is None or last is None or last.is_done:
            return None
        return Doing(masked(last.line), what_of(last.line), last.at)

    def is_changing(self):
        exchange = self.exchange
        return exchange is not None and self._under_way.is_changing(exchange.waiting())

    def has_polled(self, command):
        return False

    def has_polled_at_all(self):
        return False

    def rate(self):
        return 0

    def is_streaming_a_print(self):
        return False

    has_a_print = is_streaming_a_print

    def is_printing(self):
        return self.printer.is_printing()

    def is_paused(self):
        return self.printer.is_paused()

    def control_card_job(self, action):
        return self.printer.control_job(action)

    def end_job(self):
        # M25 answers when the machine stands, M0 then ends the job
        return "M25", "M0"

    def has_card(self):
        return self.connection is not None

    def profile(self):
        return self.printer.profile()
