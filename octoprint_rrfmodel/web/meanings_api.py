"""What the values of the model mean, in the language of the request."""

import flask
from flask_babel import gettext

from ..host.answers import answer, may_read, refusal
from ..rrf.model.marks import MARKS
from ..rrf.model.meanings import MEANINGS


def get_meanings():
    """Return unit and meaning of each path pattern, or 304 to who has them already."""
    if not may_read():
        return refusal(403, gettext("You may not read the machine's model."))
    response = answer({path: _row(path, meaning) for path, meaning in MEANINGS.items()})
    # the language may be another one next time, so that a copy has to be asked about
    response.cache_control.private = True
    response.cache_control.no_cache = True
    response.add_etag()
    return response.make_conditional(flask.request)


def _row(path, meaning):
    row = {"unit": meaning.unit, "text": gettext(meaning.text)}
    return {**row, "live": True} if "live" in MARKS.get(path, ()) else row
