"""What Moonraker's clients ask while they start, read in their public sources.

A row has the calls in their order. ``ALL`` as objects are all that the list has. An error is taken
for a failure, unless the client goes on without a word: that call says so.
"""

from tests.clients.moonraker_call import ALL, Call, Client, identify, item, objects
from tests.clients.moonraker_companions import COMPANIONS

SERVER_INFO = (
    *("klippy_connected", "klippy_state", "components", "failed_components", "warnings"),
    *("missing_klippy_requirements", "registered_directories"),
)

CLIENTS = (
    Client(
        "Mainsail",
        "mainsail-crew/mainsail src/store: server/actions.ts 0126619, printer/actions.ts 08cc4f4,"
        " printer/getters.ts 4d241fc, gui/actions.ts e8158af, gui/maintenance/actions.ts dec96b3,"
        " server/history/actions.ts 9aa813f, files/actions.ts 03b7b3a",
        (
            identify("mainsail", "web"),
            Call("server.info"),
            Call("server.config"),
            Call("machine.system_info"),
            Call("machine.proc_stats"),
            Call("server.database.list", {"root": "config"}),
            # where its namespaces are not there yet
            Call("server/files/config/.theme/default.json", verb="GET", may_fail=True),
            Call(
                "server/database/item",
                item("mainsail", "initVersion", value="v2.17.0"),
                verb="POST",
            ),
            Call("server.database.get_item", item("mainsail")),
            Call("server/files/config/.theme/maintenance.json", verb="GET", may_fail=True),
            Call(
                "server.database.post_item",
                item("maintenance", "5f9c3d3e-8a43-4d0e", value={"name": "MAINTENANCE_INIT"}),
            ),
            Call("server.webcams.list"),
            Call("server.history.list", {"start": 0, "limit": 50, "max": 100}),
            Call("server.history.totals"),
            Call("machine.device_power.devices"),
            Call("server.files.get_directory", {"path": "gcodes"}),
            Call("server.files.get_directory", {"path": "printer"}),
            Call("server.info"),
            Call("printer.info"),
            Call("printer.objects.list"),
            Call("printer.gcode.help"),
            Call("server.gcode_store"),
            Call("printer.objects.subscribe", {"objects": ALL}),
            Call("server.temperature_store"),
        ),
        {
            "server.connection.identify": ("connection_id",),
            "server.info": SERVER_INFO,
            "server.config": ("config",),
            "machine.system_info": ("system_info",),
            "server.database.list": ("namespaces",),
            "server.database.get_item": ("value",),
            "server.webcams.list": ("webcams",),
            "printer.info": ("state", "state_message", "hostname", "software_version", "cpu_info"),
            "printer.objects.list": ("objects",),
            "printer.objects.subscribe": ("status",),
            "server.gcode_store": ("gcode_store",),
        },
        (
            *("virtual_sdcard", "pause_resume", "display_status", "gcode_macro PAUSE"),
            *("gcode_macro RESUME", "gcode_macro CANCEL_PRINT"),
        ),
    ),
    Client(
        "Fluidd",
        "fluidd-core/fluidd src: init.ts 043df78, store/socket/actions.ts 5b02551,"
        " store/server/actions.ts and store/printer/actions.ts 0086d7a,"
        " api/socketActions.ts 01e3c8b",
        (
            Call("server/database/item", item("fluidd"), verb="GET", may_fail=True),
            Call("server/database/item", item("fluidd", "uiSettings", value={}), verb="POST"),
            Call("access/oneshot_token", verb="GET"),
            Call("server.info"),
            identify("fluidd", "web"),
            Call("server.files.list", {"root": "config"}, may_fail=True),
            Call("printer.info"),
            Call("printer.objects.list"),
            Call("access.get_user"),
            Call("access.users.list"),
            # nobody gets a key from us
            Call("access.get_api_key", may_fail=True),
            Call("server.config"),
            Call("machine.proc_stats"),
            Call("machine.system_info"),
            Call("server.webcams.list"),
            Call("server.history.list", {"limit": 50}),
            Call("server.history.totals"),
            Call("machine.device_power.devices"),
            Call("printer.objects.subscribe", {"objects": ALL}),
            Call("server.gcode_store"),
            Call("printer.gcode.help"),
            Call("server.temperature_store", {"include_monitors": True}),
        ),
        {
            "server.connection.identify": ("connection_id",),
            "server.info": SERVER_INFO,
            "printer.info": ("state", "state_message", "software_version"),
            "printer.objects.list": ("objects",),
            "printer.objects.subscribe": ("status",),
        },
    ),
    Client(
        "KlipperScreen",
        "KlipperScreen/KlipperScreen screen.py 00cae98, ks_includes/KlippyWebsocket.py of the same"
        " year, ks_includes/MoonrakerApi.py 27555e8, ks_includes/printer.py d0faec9",
        (
            identify("KlipperScreen", "display"),
            Call("server.info"),
            Call("machine.device_power.devices"),
            Call("server.webcams.list"),
            Call("printer.info"),
            Call("printer.objects.query", objects("configfile")),
            Call("printer.objects.list"),
            Call("printer.objects.query", {"objects": ALL}),
            Call("printer.gcode.help"),
            Call("machine.system_info"),
            Call("server.config"),
            Call(
                "printer.objects.subscribe",
                objects(
                    configfile=["config", "warnings"],
                    fan=["speed"],
                    extruder=["target", "temperature", "pressure_advance", "smooth_time", "power"],
                    heater_bed=["target", "temperature", "power"],
                    toolhead=["homed_axes", "position", "extruder", "max_accel", "max_velocity"],
                    manual_probe=["is_active"],
                    screws_tilt_adjust=["results", "error", "max_deviation"],
                ),
            ),
            Call("server.temperature_store"),
            Call("server.files.roots"),
            Call("server.files.get_directory", {"path": "gcodes"}),
        ),
        {
            "server.info": SERVER_INFO,
            "printer.info": ("state", "software_version"),
            "machine.system_info": ("system_info",),
            "machine.device_power.devices": ("devices",),
            "server.webcams.list": ("webcams",),
        },
        query="?token=KEY",
    ),
    Client(
        "Mobileraker",
        "Clon1998/mobileraker common/lib: service/moonraker/klippy_service.dart 315bace,"
        " service/moonraker/printer_service.dart 6478bc9, network/json_rpc_client.dart 09595c4,"
        " data/dto/config and data/dto/machine 2024",
        (
            identify("Mobileraker-android", "mobile"),
            Call("server.info"),
            Call("printer.info"),
            Call("printer.objects.list"),
            Call("printer.objects.query", {"objects": ALL}),
            Call("server.temperature_store"),
            Call("printer.objects.subscribe", {"objects": ALL}),
            Call("server.webcams.list"),
            Call("machine.device_power.devices"),
            Call("printer.gcode.help"),
            Call("server.gcode_store"),
        ),
        {
            "server.info": (*SERVER_INFO, "moonraker_version"),
            "printer.info": ("state", "state_message"),
        },
        ("toolhead", "gcode_move", "motion_report", "print_stats", "configfile", "virtual_sdcard"),
    ),
    *COMPANIONS,
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
