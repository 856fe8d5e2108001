"""The seam: what the rest of the plugin may ask of a line to a board, however its bytes travel."""

import abc
from typing import NamedTuple


class Doing(NamedTuple):
    """The command that the line waits for."""

    command: str
    """As it went out, without passwords and keys."""
    what: str
    """In the public contract's words, its section 2."""
    since: float
    """When it went out, by the plugin's clock."""


class Link(abc.ABC):
    """A line to one board at a time; any thread may ask, and no method waits for the board.

    Only who makes a link knows what OctoPrint has behind it.
    """

    kind = ""
    """``serial`` or ``network``."""

    protocol = None
    """``rr`` or ``dsf``, how the board is asked where it isn't by a command."""

    connection: object = None
    """What OctoPrint's hooks are handed as the connection, ``None`` without RepRapFirmware at its
    other end. It tells one connection from the next, and is nobody's to look into."""

    reported: dict = {}
    """What the printer said of its firmware when OctoPrint asked."""

    settled_at = 0.0
    """When the last command that blocks was through: older news of the machine may be wrong."""

    target_command_at = 0.0
    """When a command last went out that gives a heater a target."""

    tool_command_at = 0.0
    """When OctoPrint's own command that selects a tool last went out."""

    rewritten = 0
    """Commands of operations that went out otherwise than OctoPrint had them."""

    polls_alone = False
    """Whether a poll goes out without a status request behind it: each byte would show."""

    is_away = False
    """Whether the board doesn't answer for now; what it is sent would come late, or not at all."""

    height_map = None
    """The mesh in use (``rrf.card.height_map.HeightMap``), ``None`` where nobody has read it."""

    card = None
    """What is known of the board's card: ``listed()``, ``folders``, ``facts_of(path)``."""

    expects_refusal = False
    """Whether to look for the text that says that a polling command isn't known."""

    def attach(self, card):
        """Take what knows the card, which asks this link and so is made later."""
        self.card = card

    @property
    def is_rrf(self):
        """Whether the printer of this connection told that it runs RepRapFirmware."""
        return self.connection is not None

    @property
    @abc.abstractmethod
    def is_operational(self):
        """Whether OctoPrint has a printer at all, of whatever firmware."""

    @abc.abstractmethod
    def forget(self):
        """Know no printer: the connection is gone."""

    ##~~ towards the board

    @abc.abstractmethod
    def ask(self, request):
        """Send a question (``rrf.wire.request``); the poller is told when it has left."""

    @abc.abstractmethod
    def give_up(self):
        """See to it that a request that was asked and has not left doesn't go out any more."""

    @abc.abstractmethod
    def send(self, lines, tags, force=False):
        """Queue lines of G-code; ``force`` goes past what is queued already.

        Hooks of other plugins run meanwhile: not to be called by the worker or Tornado's loop.
        """

    @abc.abstractmethod
    def send_later(self, lines, tags):
        """Queue lines from a thread that must not wait, for hooks of other plugins least of all.

        They stay in order; of a connection that is over by then nothing goes into the next one.
        """

    @abc.abstractmethod
    def carried(self, lines, machine):
        """Return lines in the forms that this link takes to the board unharmed."""

    @abc.abstractmethod
    def stop_now(self, tags):
        """Stop the machine at once, whatever code of other plugins hangs; doesn't wait for it."""

    @property
    @abc.abstractmethod
    def can_restart(self):
        """Whether there was a board that ``restart`` could reach."""

    @abc.abstractmethod
    def restart(self, is_running):
        """Restart the board and connect again; takes a minute, raises where it doesn't come back.

        ``is_running()`` says whether the board prints by itself, ``None`` while nobody knows. What
        somebody has begun meanwhile, here or there, is left alone. The one method that waits: on a
        thread of whoever calls it.
        """

    @abc.abstractmethod
    def reconnect(self):
        """Close the connection and connect to the same board again; takes seconds.

        Where something is printed it does nothing. On a thread of whoever calls it.
        """

    ##~~ why the board can't be asked, and what it is asked to do

    @abc.abstractmethod
    def blocked(self):
        """Return why no question may go out, ``None`` where one may."""

    @abc.abstractmethod
    def doing(self):
        """Return the command that the line waits for (``Doing``), ``None`` for none."""

    def is_changing(self):
        """Return whether a command that may home, heat or choose tools waits or is under way."""
        return False

    def silent_for(self):
        """Return how many seconds nothing has come while a command is awaited that takes long."""
        return 0.0

    def waits_in_a_box(self):
        """Return whether what the line waits for is the answer to a message box.

        M292 with ``force`` then goes past all that is queued.
        """
        return False

    @abc.abstractmethod
    def has_polled(self, command):
        """Return whether a command in OctoPrint's log was a poll, of earlier connections too."""

    @abc.abstractmethod
    def has_polled_at_all(self):
        """Return whether there is anything of the plugin's in OctoPrint's log."""

    @abc.abstractmethod
    def rate(self):
        """Return the line's rate in bits a second, 0 where there is none or it is unknown."""

    def read_height_map(self):
        """Return a future of the mesh in use and its file; ``None`` where no file can be read.

        The future raises ``host.answers.RequestRefused`` where there is none.
        """
        return None

    ##~~ OctoPrint's print

    @abc.abstractmethod
    def is_streaming_a_print(self):
        """Return whether OctoPrint sends a print's lines right now."""

    @abc.abstractmethod
    def has_a_print(self):
        """Return whether OctoPrint prints, or has paused, a file of its own on this board."""

    @abc.abstractmethod
    def is_printing(self):
        """Return whether OctoPrint shows a print as going on, of its own or from the card."""

    @abc.abstractmethod
    def is_paused(self):
        """Return whether OctoPrint shows a print as paused."""

    @abc.abstractmethod
    def control_card_job(self, action):
        """Return whether OctoPrint itself did that to the board's job, which it shows as its own.

        ``action`` is ``pause``, ``resume`` or ``cancel``.
        """

    @abc.abstractmethod
    def end_job(self):
        """Return the lines that end the board's job, and see to it that they do."""

    @abc.abstractmethod
    def has_card(self):
        """Return whether OctoPrint may be asked about the board's card."""

    @abc.abstractmethod
    def profile(self):
        """Return the printer profile that the connection goes by, ``None`` without one."""
