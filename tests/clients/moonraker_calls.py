"""What Moonraker's clients ask while they start, read in their public sources.

A row has the calls in their order. ``ALL`` as objects are all that the list has. An error is taken
for a failure, unless the client goes on without a word: that call says so.
"""

from typing import Any, NamedTuple

ALL = "all"


class Call(NamedTuple):
    """A call over the socket; ``verb`` makes it one over HTTP, with the path in ``method``."""

    method: str
    params: dict[str, Any] = {}
    verb: str = ""
    may_fail: bool = False


class Client(NamedTuple):
    """One client, and what it looks for in the answers."""

    name: str
    source: str
    calls: tuple[Call, ...]
    results: dict[str, tuple[str, ...]] = {}
    """Members without which it fails."""
    objects: tuple[str, ...] = ()
    """Printer objects without which it complains."""


def _identify(name, kind):
    return Call(
        "server.connection.identify",
        {"client_name": name, "version": "1.0.0", "type": kind, "url": "https://example.org"},
    )


SERVER_INFO = (
    *("klippy_connected", "klippy_state", "components", "failed_components", "warnings"),
    *("missing_klippy_requirements", "registered_directories"),
)

CLIENTS = (
    Client(
        "Mainsail",
        "mainsail-crew/mainsail src/store: server, printer, gui, files, server/*/actions.ts",
        (
            _identify("mainsail", "web"),
            Call("server.info"),
            Call("server.config"),
            Call("machine.system_info"),
            Call("machine.proc_stats"),
            Call("server.database.list", {"root": "config"}),
            Call(
                "server.database.post_item",
                {"namespace": "mainsail", "key": "initVersion", "value": "2.17.0"},
            ),
            Call("server.database.get_item", {"namespace": "mainsail"}),
            Call("server.webcams.list"),
            Call("printer.info"),
            Call("printer.objects.list"),
            Call("printer.gcode.help"),
            Call("server.gcode_store"),
            Call("printer.objects.subscribe", {"objects": ALL}),
            Call("server.temperature_store"),
            Call("server.files.get_directory", {"path": "gcodes"}),
            Call("server.history.list", {"start": 0, "limit": 50}),
            Call("server.history.totals"),
            Call("machine.device_power.devices"),
            Call("machine.update.status", {"refresh": False}),
            Call("server.job_queue.status"),
            Call("server.announcements.list", {"include_dismissed": True}),
        ),
        {
            "server.connection.identify": ("connection_id",),
            "server.info": SERVER_INFO,
            "machine.system_info": ("system_info",),
            "server.database.list": ("namespaces",),
            "server.webcams.list": ("webcams",),
            "printer.info": ("state", "state_message", "hostname", "software_version"),
            "server.gcode_store": ("gcode_store",),
        },
        (
            *("virtual_sdcard", "pause_resume", "display_status", "gcode_macro PAUSE"),
            *("gcode_macro RESUME", "gcode_macro CANCEL_PRINT"),
        ),
    ),
    Client(
        "Fluidd",
        "fluidd-core/fluidd src/store: socket, server, printer; src/api/socketActions.ts",
        (
            _identify("fluidd", "web"),
            Call("server.database.get_item", {"namespace": "fluidd"}, may_fail=True),
            Call(
                "server.database.post_item",
                {"namespace": "fluidd", "key": "uiSettings", "value": {}},
            ),
            Call("server.database.get_item", {"namespace": "webcams"}, may_fail=True),
            Call("server.info"),
            Call("server.config"),
            Call("machine.proc_stats"),
            Call("machine.system_info"),
            Call("server.files.list", {"root": "config"}, may_fail=True),
            Call("printer.info"),
            Call("printer.objects.list"),
            Call("printer.objects.subscribe", {"objects": ALL}),
            Call("server.temperature_store", {"include_monitors": True}),
            Call("server.gcode_store"),
            Call("printer.gcode.help"),
            Call("server.webcams.list"),
            Call("server.history.list", {"limit": 50}),
            Call("server.history.totals"),
            Call("server.job_queue.status"),
            Call("machine.device_power.devices"),
            Call("machine.update.status", {"refresh": False}),
            Call("server.announcements.list"),
        ),
        {
            "server.connection.identify": ("connection_id",),
            "server.info": SERVER_INFO,
            "printer.info": ("state", "state_message"),
            "printer.objects.list": ("objects",),
            "printer.objects.subscribe": ("status",),
        },
    ),
    Client(
        "KlipperScreen",
        "KlipperScreen/KlipperScreen screen.py, ks_includes/MoonrakerApi.py, KlippyRest.py",
        (
            Call("access/oneshot_token", verb="GET"),
            _identify("KlipperScreen", "display"),
            Call("server.info"),
            Call("machine.device_power.devices"),
            Call("server.webcams.list"),
            Call("printer.info"),
            Call("printer.objects.query", {"objects": {"configfile": None}}),
            Call("printer.objects.list"),
            Call("printer.objects.query", {"objects": ALL}),
            Call("printer.gcode.help"),
            Call("machine.system_info"),
            Call("server.config"),
            Call("printer.objects.subscribe", {"objects": ALL}),
            Call("server.temperature_store"),
            Call("server.files.roots"),
            Call("server.files.get_directory", {"path": "gcodes"}),
        ),
        {
            "server.info": SERVER_INFO,
            "printer.info": ("state",),
            "machine.system_info": ("system_info",),
            "server.webcams.list": ("webcams",),
        },
    ),
    Client(
        "Mobileraker",
        "Clon1998/mobileraker common/lib/service; mobileraker_companion data_sync_service.py",
        (
            _identify("Mobileraker", "mobile"),
            Call("server.info"),
            Call("printer.info"),
            Call("machine.system_info"),
            Call("printer.objects.list"),
            Call("printer.objects.query", {"objects": ALL}),
            Call("printer.objects.subscribe", {"objects": ALL}),
            Call("printer.gcode.help"),
            Call("server.temperature_store"),
            Call("server.gcode_store"),
            Call("server.webcams.list"),
            Call("server.job_queue.status"),
            Call("server.announcements.list", {"include_dismissed": False}),
            Call("machine.device_power.devices"),
            Call("server.database.get_item", {"namespace": "mobileraker"}, may_fail=True),
            Call("server.files.get_directory", {"path": "gcodes", "extended": True}),
        ),
        {"server.info": SERVER_INFO, "printer.info": ("state", "state_message")},
    ),
    Client(
        "Obico",
        "TheSpaghettiDetective/moonraker-obico moonraker_obico/moonraker_conn.py",
        (
            Call("server/info", verb="GET"),
            Call("printer/objects/query", {"heaters": ""}, verb="GET"),
            Call("server/history/list", {"order": "desc", "limit": "1"}, verb="GET"),
            Call("server/database/item", {"namespace": "webcams"}, verb="GET", may_fail=True),
            Call(
                "printer.objects.subscribe",
                {
                    "objects": {
                        "print_stats": ["state", "message", "filename"],
                        "webhooks": ["state", "state_message"],
                        "history": None,
                    }
                },
            ),
            Call(
                "printer.objects.query",
                {
                    "objects": dict.fromkeys(
                        (
                            *("webhooks", "print_stats", "virtual_sdcard", "display_status"),
                            *("heaters", "toolhead", "extruder", "gcode_move"),
                        )
                    )
                },
            ),
        ),
        {"server/info": ("klippy_state",), "printer/objects/query": ("status",)},
    ),
    Client(
        "OctoEverywhere, OctoApp",
        "QuinnDamerell/OctoPrint-OctoEverywhere moonraker_octoeverywhere/moonrakerclient.py",
        (
            Call("server.info"),
            Call(
                "printer.objects.subscribe",
                {
                    "objects": {
                        "print_stats": ["state", "filename", "message"],
                        "webhooks": None,
                        "virtual_sdcard": None,
                        "history": None,
                    }
                },
            ),
        ),
        {"server.info": ("klippy_state",), "printer.objects.subscribe": ("status",)},
    ),
    Client(
        "moonraker-telegram-bot",
        "nlef/moonraker-telegram-bot bot/klippy.py, bot/websocket_helper.py",
        (
            Call("printer/info", verb="GET"),
            Call("access/oneshot_token", verb="GET"),
            Call("printer/objects/list", verb="GET"),
            Call("printer.info"),
            Call("machine.device_power.devices", may_fail=True),
            Call(
                "printer.objects.subscribe",
                {
                    "objects": {
                        "print_stats": None,
                        "display_status": None,
                        "toolhead": ["position"],
                        "gcode_move": ["position", "gcode_position"],
                        "virtual_sdcard": ["progress"],
                    }
                },
            ),
        ),
        {"printer.info": ("state",), "printer/objects/list": ("objects",)},
    ),
    Client(
        "Home Assistant",
        "marcolivierarsenault/moonraker-home-assistant custom_components/moonraker",
        (
            Call("printer.info"),
            Call("printer.objects.list"),
            Call("printer.objects.query", {"objects": ALL}),
            Call("printer.gcode.help"),
            Call("machine.device_power.devices"),
            Call("machine.update.status"),
            Call("server.history.totals"),
            Call("server.webcams.list"),
        ),
        {"printer.info": ("hostname", "software_version", "state")},
    ),
    Client(
        "klipper-tui",
        "PyPI klipper-tui 0.20.2, klipper_tui/moonraker.py",
        (
            Call("server.info"),
            Call("printer.objects.list"),
            Call("printer.objects.subscribe", {"objects": ALL}),
            Call("server.temperature_store", {"include_monitors": False}),
            Call("server.files.list", {"root": "gcodes"}),
        ),
        {"server.info": ("klippy_state",), "printer.objects.subscribe": ("status",)},
    ),
)
