"""Commands of a person or a program, as lines for the firmware, or why they can't be sent.

``table`` has one row a command, ``translation`` makes lines of it; what a parameter may be is in
``parameters`` and ``things``, what goes out in one module a topic.
"""

from .box import identity_of_box
from .outcome import Refusal, Situation
from .row import Command
from .system import root_of
from .table import COMMANDS
from .translation import translate

__all__ = ["COMMANDS", "Command", "Refusal", "Situation", "identity_of_box", "root_of", "translate"]
