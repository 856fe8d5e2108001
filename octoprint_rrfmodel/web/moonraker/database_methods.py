"""Methods about what clients keep for themselves."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from .methods import Method

CONTROL = "PLUGIN_RRFMODEL_CONTROL"


def database_methods(database):
    """Return the rows; ``database`` keeps the namespaces (``Database``)."""

    def get(call):
        key = call.params.get("key")
        return _item(call, database.get(call.text("namespace"), key))

    def post(call):
        if "value" not in call.params:
            raise RequestRefused(400, gettext("%(name)s is missing.", name="value"))
        value = call.params["value"]
        database.put(call.text("namespace"), call.params.get("key"), value)
        return _item(call, value)

    def delete(call):
        return _item(call, database.delete(call.text("namespace"), call.params.get("key")))

    return (
        Method(
            "server.database.list", lambda call: {"namespaces": database.names(), "backups": []}
        ),
        Method("server.database.get_item", get),
        Method("server.database.post_item", post, CONTROL),
        Method("server.database.delete_item", delete, CONTROL),
    )


def _item(call, value):
    return {"namespace": call.text("namespace"), "key": call.params.get("key"), "value": value}
