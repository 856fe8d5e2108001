"""Methods about the printer and what was said to it: objects, G-code, the emergency stop."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...rrf import klipper
from .gcode_store import MOST_LINES
from .methods import CONTROL, Method

EMERGENCY_STOP = "printer.emergency_stop"


def printer_methods(
    objects, scripts, store, *, websocket_count, components=list, refused=lambda text: None
):
    """Return the rows; ``websocket_count()`` is the number of sockets that are open.

    ``components()`` names the parts of Moonraker that are here. ``objects`` gives the printer
    objects, ``scripts`` sends G-code, ``store`` has what was said. ``refused(text)`` is told why a
    script was.
    """

    def server_info(call):
        return {**objects.server_info(websocket_count()), "components": components()}

    def run_script(call):
        try:
            scripts.run(call.params.get("script"), call.caller)
        except RequestRefused as error:
            refused(str(error))
            raise
        return "ok"

    def stop(call):
        scripts.emergency_stop()
        return "ok"

    def subscribe(call):
        if call.socket is None:
            raise RequestRefused(400, gettext("Objects are subscribed to by a websocket."))
        wanted = wanted_of(call)
        found = objects.query(wanted)
        call.socket.subscribed.append((wanted, found["status"]))
        return found

    return (
        Method("server.info", server_info),
        Method("server.gcode_store", lambda call: said_lately(call, store)),
        Method("printer.info", lambda call: objects.printer_info()),
        Method("printer.objects.list", lambda call: {"objects": objects.names()}),
        Method(
            "printer.objects.query",
            lambda call: objects.query(wanted_of(call)),
            verbs=("GET", "POST"),
        ),
        Method("printer.objects.subscribe", subscribe, verbs=("POST",)),
        Method("printer.query_endstops.status", lambda call: endstops(objects)),
        Method("printer.gcode.help", lambda call: objects.help_texts()),
        Method("printer.gcode.script", run_script, CONTROL, verbs=("POST",)),
        Method(EMERGENCY_STOP, stop, CONTROL, verbs=("POST",)),
    )


def wanted_of(call):
    """Return the objects that a call names, each with its fields."""
    try:
        return klipper.wanted_of(call.params.get("objects"))
    except ValueError as error:
        raise RequestRefused(400, str(error)) from None


def endstops(objects):
    """Return the state of each axis' endstop, in Klipper's words."""
    found = objects.query({"query_endstops": None})["status"]["query_endstops"]
    states = found.get("last_query") or {}
    return {name: "TRIGGERED" if state else "open" for name, state in states.items()}


def said_lately(call, store):
    """Return the latest commands and responses."""
    lines = store.latest(min(call.whole("count", MOST_LINES), MOST_LINES))
    return {"gcode_store": [{**line, "message": _marked(line)} for line in lines]}


def _marked(line):
    is_said = line["type"] == "response"
    return klipper.as_said(line["message"]) if is_said else line["message"]
