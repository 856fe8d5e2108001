"""The JSON that a request brings."""


def json_of(request, force=False):
    """Return a request's JSON, ``None`` where it is none, or is nested deeper than can be read.

    Flask raises for the latter, also where it is to be silent. ``force`` reads it whatever the
    request says that it is.
    """
    try:
        return request.get_json(force=force, silent=True)
    except RecursionError:
        return None
