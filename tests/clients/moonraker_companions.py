"""Programs beside Moonraker that watch, report and connect, by the calls that they start with."""

from tests.clients.moonraker_call import Call, Client, identify, item, objects

OCTOEVERYWHERE = (
    Call("server.info"),
    Call(
        "printer.objects.subscribe",
        # a set, as its JSON has it
        objects(
            *("webhooks", "virtual_sdcard", "history"),
            print_stats="{'state', 'filename', 'message'}",
        ),
    ),
    Call("printer.objects.query", objects("print_stats")),
    Call("server.webcams.list"),
)

COMPANIONS = (
    Client(
        "Obico",
        "TheSpaghettiDetective/moonraker-obico moonraker_obico: moonraker_conn.py d8d44d2,"
        " app.py 11d93b6",
        (
            Call("server/info", verb="GET"),
            identify("Obico", "agent"),
            # it is told when a macro wants it, and there is none
            Call(
                "connection.register_remote_method",
                {"method_name": "obico_remote_event"},
                may_fail=True,
            ),
            Call("printer/objects/list", verb="GET"),
            Call(
                "printer.objects.subscribe",
                objects(
                    print_stats=["state", "message", "filename", "info"],
                    webhooks=["state", "state_message"],
                    gcode_move=["speed_factor", "extrude_factor"],
                    fan="speed",
                ),
            ),
            Call("printer/info", verb="GET"),
            Call("printer/objects/query", {"heaters": ""}, verb="GET"),
            Call(
                "printer.objects.query",
                objects(
                    *("webhooks", "print_stats", "virtual_sdcard", "display_status", "heaters"),
                    *("toolhead", "extruder", "gcode_move", "gcode_macro _OBICO_LAYER_CHANGE"),
                    *("fan", "heater_bed"),
                ),
            ),
            Call("server/database/item", item("mainsail", "presets"), verb="GET", may_fail=True),
            Call("machine/update/status", {"refresh": "false"}, verb="GET"),
            Call("server/history/list", {"order": "desc", "limit": "1"}, verb="GET"),
            Call(
                "server/database/item",
                item("obico", "printer_id", value="5"),
                verb="POST",
                is_form=True,
            ),
        ),
        {"server/info": ("klippy_state",), "printer/objects/query": ("status",)},
    ),
    Client(
        "OctoEverywhere",
        "QuinnDamerell/OctoPrint-OctoEverywhere"
        " moonraker_octoeverywhere/moonrakerclient.py 0653931",
        (identify("OctoEverywhere", "agent", api_key="KEY"), *OCTOEVERYWHERE),
        {"server.info": ("klippy_state",), "printer.objects.subscribe": ("status",)},
    ),
    Client(
        "OctoApp",
        "crysxd/OctoApp-Plugin moonraker_octoapp: moonrakerclient.py 00a51b1,"
        " moonrakerdatabase.py 0e4210d",
        (
            identify("OctoApp", "agent", api_key="KEY"),
            *OCTOEVERYWHERE,
            Call("server.database.get_item", item("octoapp", "apps"), may_fail=True),
            Call(
                "server.database.get_item",
                item("mainsail", "general.printername"),
                may_fail=True,
            ),
            Call(
                "server.database.get_item",
                item("fluidd", "uiSettings.general.instanceName"),
                may_fail=True,
            ),
            Call(
                "server.database.get_item",
                item("ocotapp", "public.encryptionKey"),
                may_fail=True,
            ),
            Call(
                "server.database.post_item",
                item("octoapp", "public", value={"pluginVersion": "2.0.0", "lastSeen": 1.5}),
            ),
        ),
        {"server.info": ("klippy_state",), "printer.objects.subscribe": ("status",)},
    ),
    Client(
        "moonraker-telegram-bot",
        "nlef/moonraker-telegram-bot bot/klippy.py and bot/websocket_helper.py c33de4e",
        (
            Call("printer/info", verb="GET"),
            Call("access/oneshot_token", verb="GET"),
            Call("printer.info"),
            Call("machine.device_power.devices"),
            Call("printer/objects/list", verb="GET"),
            Call(
                "printer.objects.subscribe",
                objects(
                    *("print_stats", "display_status"),
                    toolhead=["position"],
                    gcode_move=["position", "gcode_position"],
                    virtual_sdcard=["progress"],
                ),
            ),
            Call("machine/update/status", {"refresh": "false"}, verb="GET"),
            Call("server/announcements/feed", {"name": "bot"}, verb="POST", may_fail=True),
            Call("server/database/item", item("telegram-bot", "a"), verb="GET", may_fail=True),
        ),
        {
            "printer.info": ("state", "state_message"),
            "printer/objects/list": ("objects",),
            "printer.objects.subscribe": ("status",),
        },
    ),
    Client(
        "Home Assistant",
        "marcolivierarsenault/moonraker-home-assistant custom_components/moonraker: __init__.py"
        " 285e281, sensor.py 0181cf8, number.py 48848f4, switch.py and binary_sensor.py 5ff9e21,"
        " button.py 4fa7b55, light.py e164604",
        (
            Call("printer.info"),
            Call(
                "printer.objects.query",
                objects(
                    print_stats=["state", "message", "filename", "print_duration", "info"],
                    idle_timeout=["state"],
                    display_status=["message", "progress"],
                    virtual_sdcard=["progress", "file_position", "total_layer", "current_layer"],
                    gcode_move=["speed"],
                    motion_report=["live_velocity"],
                    toolhead=["position"],
                    system_stats=["sysload", "memavail"],
                ),
            ),
            Call("machine.system_info"),
            Call("printer.objects.list"),
            Call("printer.objects.query", objects(fan=["rpm"])),
            Call("server.history.totals"),
            Call("machine.update.status"),
            Call("server.job_queue.status"),
            Call("server.spoolman.get_spool_id", may_fail=True),
            Call("server.webcams.list"),
            Call("printer.gcode.help"),
            Call("machine.device_power.devices"),
            Call("printer.objects.query", objects(configfile=["settings"])),
            # what it makes of a text for a list of fields
            Call("printer.objects.query", objects(q=["u"], status=["update_available"])),
        ),
        {
            "printer.info": ("hostname", "state", "state_message"),
            "machine.system_info": ("system_info",),
            "server.history.totals": ("job_totals",),
            "machine.update.status": ("version_info",),
            "server.job_queue.status": ("queue_state", "queued_jobs"),
            "machine.device_power.devices": ("devices",),
        },
    ),
)
