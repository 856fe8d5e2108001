"""The board as OctoPrint 2.0's printer. Reading this module registers it: on 1.11 nobody does."""

# OctoPrint's printer can't be imported from any side
import octoprint.filemanager  # noqa: F401
from octoprint.printer.connection import ConnectedPrinter, ConnectedPrinterState

from .address import address_of
from .card_files import CardFiles
from .jobs import Jobs
from .operations import Operations
from .printer_side import PrinterSide
from .reasons import reason

BUSY = frozenset((ConnectedPrinterState.TRANSFERRING_FILE,))


class NetworkPrinter(Operations, Jobs, CardFiles, ConnectedPrinter):
    """A board with RepRapFirmware that hangs on the network.

    OctoPrint makes one for each connection; ``network`` is what they all stand on.
    """

    connector = "rrfmodel"
    name = "RepRapFirmware (network)"

    network = None

    @classmethod
    def connection_options(cls):
        if cls.network is None:
            return {"host": [], "found": []}
        hosts, found = cls.network.memory.hosts(), cls.network.found.boards()
        new = [{"host": host, "name": found[host]} for host in sorted(found) if host not in hosts]
        return {"host": hosts, "found": new}

    @classmethod
    def connection_preconditions_met(cls, params):
        return address_of(params.get("host")) is not None

    def __init__(self, owner, listener=None, profile=None, *args, host="", **kwargs):
        super().__init__(owner, listener, profile, *args, **kwargs)
        self._host = host if isinstance(host, str) else ""
        self.side = PrinterSide(self, self._listener, self.network)

    @property
    def connection_parameters(self):
        return {**super().connection_parameters, "host": self._host}

    def connect(self, *args, **kwargs):
        address = address_of(self._host)
        if address is None:
            self.side.fail(reason("no_address", ""))
            return
        self.set_state(ConnectedPrinterState.CONNECTING)
        self.network.open(self.side, address)

    def disconnect(self, *args, **kwargs):
        self.side.fall_silent()
        self.network.close(self.side)
        self.set_state(ConnectedPrinterState.CLOSED)

    @property
    def host(self):
        """Where the board is, as it was given."""
        return self._host

    @property
    def profile(self):
        """The printer profile that the connection goes by."""
        return self._profile

    def connect_again(self):
        """Connect to the same board, for what is looked at only then."""
        owner, profile = self._owner, self._profile
        owner.disconnect()
        owner.connect(
            connector=self.connector,
            parameters={"host": self._host},
            profile=profile.get("id") if profile else None,
        )

    def trigger(self, event, user):
        """Fire an event about the job."""
        self._owner.trigger_printjob_event(event, user=user)

    def is_ready(self, *args, **kwargs):
        return self.state == ConnectedPrinterState.OPERATIONAL

    def get_error(self, *args, **kwargs):
        return self.error_info.error if self.error_info else ""

    def repair_communication(self, *args, **kwargs):
        """There is no acknowledgement to be faked."""

    def emergency_stop(self, *args, **kwargs):
        self.network.link.stop_now(kwargs.get("tags"))
