"""The dialects by the name that a greeting has for them."""

from .sbc import Sbc
from .standalone import Standalone

DIALECTS = {dialect.protocol: dialect for dialect in (Standalone, Sbc)}
