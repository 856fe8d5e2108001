"""What differs between boards on the network: how one is asked, told, given files and stopped.

Whoever talks with a board does it in its dialect and asks no further what it is.
"""

import abc


class Dialect(abc.ABC):
    """How to talk with the board of a session; each method raises what a session raises.

    What is asked and told in turn is called on the exchange's thread, files and stops on any.
    """

    protocol = ""
    """Its name in the plugin's state."""

    settle_seconds = 0.3
    """Time in which the board takes up what it was sent, and the model shows it."""

    commands = None
    """What commands go out through (``outgoing.Outgoing``, ``codes.Codes``)."""

    files = None
    """How its card's files are changed (``Files``)."""

    @abc.abstractmethod
    def enter(self):
        """Begin, behind a login."""

    @abc.abstractmethod
    def leave(self):
        """Be through with the board, whether it is there or not; raises nothing."""

    @abc.abstractmethod
    def up_time(self):
        """Return the board's up-time, ``None`` where it tells none."""

    @property
    @abc.abstractmethod
    def has_news(self):
        """Whether there is something to be heard at once."""

    @abc.abstractmethod
    def news(self):
        """Return what there is to be told (``news.News``): names with their arguments."""

    @abc.abstractmethod
    def answer(self, request, tell):
        """Return of when the answer to a question is, and its text; ``None`` for what can't be
        asked. What the board has said before is told first: ``tell(name, *arguments)``."""

    def costs(self, request):
        """Return whether the board is asked for the answer to a question of the poller's."""
        return True

    @abc.abstractmethod
    def read(self, request):
        """Return the answer to a question about files, as a line has it."""

    @property
    def is_executing(self):
        """Whether a command is known not to be through."""
        return False

    @abc.abstractmethod
    def take_at_once(self, command):
        """Give the board a command past all that waits; return whether it may have it."""

    @abc.abstractmethod
    def is_halted(self):
        """Return whether the board says that it stands."""


class Files(abc.ABC):
    """Reads and changes files of a board's card; paths are whole.

    What changes something returns whether it was done.
    """

    is_proof = False
    """Whether a file that was brought needs no further look at its size and date."""

    @abc.abstractmethod
    def open(self, path, most):
        """Return a response to read a file of ``most`` bytes from; whoever gets it closes it.

        Its ``status`` is 200 for a file that is there.
        """

    @abc.abstractmethod
    def upload(self, body, path, *, size, crc, modified, told):
        """Bring a file to the card; ``told(count)`` after each piece that has left."""

    @abc.abstractmethod
    def delete(self, path):
        """Delete a file, or a folder with nothing in it."""

    @abc.abstractmethod
    def make_folder(self, path):
        """Make a folder."""

    @abc.abstractmethod
    def move(self, source, target):
        """Move a file or a folder, over what may be there."""
