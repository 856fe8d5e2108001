"""Boards on the network, put together: the link, OctoPrint's printer, their thread."""

from functools import partial

from ...host.discovery import addresses_of_discovery
from ..worker import Worker
from .card import Card
from .found_boards import FoundBoards
from .machine_files import MachineFiles
from .memory import Memory
from .network_link import NetworkLink
from .nobody import Nobody
from .session import Session
from .simulated_host import SimulatedHost
from .transport import Transport


class Network:
    """Opens and closes the connection with one board; made in OctoPrint 2.0 alone.

    ``links`` says which link is in use, ``host`` is OctoPrint, ``known`` what is known of the
    machine. ``notify(name, *arguments)`` only takes note, ``sent(line, tags)`` is told of commands.
    """

    def __init__(self, links, host, *, known, notify, clock, sent):
        self._links = links
        self.host = host
        self.notify = notify
        self.clock = clock
        self._known = known
        self.model = known.model
        self.machine = known.machine
        self.memory = Memory(host.settings)
        self._worker = Worker("rrfmodel.printer")
        self._worker.attach({"call": lambda function, *arguments: function(*arguments)})
        self._simulated = SimulatedHost(host.simulator)
        self.found = FoundBoards(lambda: addresses_of_discovery(host.plugins()), clock)
        self.start = self._worker.start
        self._is_looking = False
        self.link = NetworkLink(
            notify,
            clock,
            model=known.model,
            patience=self.memory.patience,
            nobody=Nobody(),
            sent=sent,
        )
        self.card = Card(self.link, known.model, host.folder)
        self.link.attach(self.card)
        self.machine_files = MachineFiles(self.link, self.card, known.model)

    def stop(self):
        """End the threads, and the simulated board."""
        self.found.stop()
        self._worker.stop()
        self._simulated.stop()

    def register(self):
        """Offer the connector to OctoPrint."""
        # the module is there in 2.0 alone, and being read is what registers its class
        from .connector import NetworkPrinter
        from .download_handler import offer

        NetworkPrinter.network = self
        offer(self.card)

    def open(self, printer, address):
        """Begin to talk with the board at an address."""
        transport = Transport(self._simulated.place_of(address))
        session = Session(transport, partial(self.memory.password, address), self.clock)
        self._links.use(self.link)
        self.link.open(printer, session)

    def close(self, printer):
        """Talk no more with a printer's board, if it is still the one."""
        if self.link.printer is printer:
            self.link.close()
            self.card.downloads.forget()
            self._links.leave(self.link)
            self.notify("disconnected")

    def later(self, function, *arguments):
        """Have something called on the thread on which OctoPrint is told of the board."""
        self._worker.notify("call", function, *arguments)

    ##~~ a listener

    def identified(self):
        """Begin with a board that has just said what it is."""
        self.card.forget()

    def replied(self, taken, asked_at):
        """Let the link and OctoPrint's printer look at what the board has told."""
        self.link.replied(taken, asked_at)
        if self._known.is_ready():
            self.card.look()
        if self.link.exchange is not None and not self._is_looking:
            self._is_looking = True
            self.later(self._look, self.link.printer)

    def reset(self):
        """Let them know that the board began anew."""
        self.link.reset()
        self.replied(None, 0.0)

    def _look(self, printer):
        self._is_looking = False
        printer.look()
