"""The file that OctoPrint streams: where its lines stand, and what they were before OctoPrint."""

from ...host.tags import FILE_TAG
from ...rrf.gcode.file_place import Place, text_at
from ...rrf.gcode.quotes import has_odd_quote, without_comment

POSITION = "filepos:"
"""OctoPrint's tag of a line of a file: where the next one begins."""


class FileLines:
    """Knows the file of ``link``'s connection (``SerialLink``)."""

    def __init__(self, link):
        self._link = link

    def place(self, cmd, tags):
        """Return where a line of the file stands (``Place``); reads nothing."""
        found = next((tag[len(POSITION) :] for tag in tags if tag.startswith(POSITION)), "")
        file = getattr(self._link.connection, "_currentFile", None)
        if file is None or not found.isdigit():
            return Place(cmd)
        return Place(cmd, file.getFilename(), int(found))

    def started_at(self):
        """Return by what one print of the file is told from the next."""
        file = getattr(self._link.connection, "_currentFile", None)
        return None if file is None else file.getStartTime()

    def whole(self, cmd, tags):
        """Return a line that OctoPrint has cut inside of quotes as it stands in the file.

        ``None`` where it isn't a file's, is not to be found, or was no other there.
        """
        if FILE_TAG not in tags:
            return None
        text = text_at(self.place(cmd, tags))
        if text is None:
            return None
        found = without_comment(text)
        return None if has_odd_quote(found) else found
