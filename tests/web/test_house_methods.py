"""Methods about server, computer, power and access, each without an OctoPrint around it."""

import json
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
from octoprint.schema.webcam import RatioEnum, Webcam, WebcamCompatibility

from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.web.moonraker import computer
from octoprint_rrfmodel.web.moonraker.access_methods import access_methods
from octoprint_rrfmodel.web.moonraker.connection_methods import connection_methods
from octoprint_rrfmodel.web.moonraker.machine_methods import machine_methods
from octoprint_rrfmodel.web.moonraker.methods import Call, Method, Methods, run
from octoprint_rrfmodel.web.moonraker.power import PowerDevices
from octoprint_rrfmodel.web.moonraker.printer_methods import printer_methods
from octoprint_rrfmodel.web.moonraker.server_methods import components_of, server_methods
from octoprint_rrfmodel.web.moonraker.tokens import MOST_TOKENS, SECONDS, OneshotTokens
from octoprint_rrfmodel.web.moonraker.webcams import webcam
from tests.support.refusals import refused


def caller(*permissions, **members):
    may = lambda permission: permission in permissions  # noqa: E731
    return SimpleNamespace(
        may=may, may_read=lambda: may("PLUGIN_RRFMODEL_READ"), **{"name": "somebody", **members}
    )


EVERYTHING = caller("PLUGIN_RRFMODEL_READ", "PLUGIN_RRFMODEL_CONTROL", "WEBCAM")


def ask(rows, method, by=EVERYTHING, /, socket=None, **params):
    return run(Methods(rows).named(method), Call(params, by, socket))


# webcams


def provided(stream="/webcam/?action=stream", snapshot=None, **members):
    compat = WebcamCompatibility(
        stream=stream, snapshot=snapshot or "", streamRatio=RatioEnum.four_three
    )
    told = {"name": "classic", "displayName": "Nozzle", "compat": compat, "snapshotDisplay": ""}
    config = Webcam(**{**told, **members})
    return SimpleNamespace(config=config, providerIdentifier="classicwebcam")


def test_a_webcam_in_moonrakers_form():
    found = webcam(provided(flipH=True, rotate90=True), True)
    assert found["name"] == "Nozzle"
    assert found["uid"] == "classicwebcam:classic"
    assert (found["flip_horizontal"], found["flip_vertical"], found["rotation"]) == (
        True,
        False,
        270,
    )
    assert (found["aspect_ratio"], found["enabled"], found["source"]) == ("4:3", True, "config")
    assert webcam(provided(), False)["enabled"] is False
    json.dumps(found)


@pytest.mark.parametrize(
    "stream, service, address",
    [
        ("/webcam/?action=stream", "mjpegstreamer", "/webcam/?action=stream"),
        ("http://cam/a.M3U8?b", "hlsstream", "http://cam/a.M3U8?b"),
        ("webrtc://cam/webrtc", "webrtc-camerastreamer", "http://cam/webrtc"),
        ("webrtcs://cam/webrtc", "webrtc-camerastreamer", "https://cam/webrtc"),
    ],
)
def test_the_kind_of_a_stream(stream, service, address):
    found = webcam(provided(stream), True)
    assert (found["service"], found["stream_url"]) == (service, address)


@pytest.mark.parametrize("members", [{"compat": None}, {}], ids=["none at all", "empty"])
def test_what_others_can_not_show_is_left_out(members):
    assert webcam(provided("", **members), True) is None


@pytest.mark.parametrize(
    "snapshot, told",
    [
        ("http://127.0.0.1:8080/?action=snapshot", ""),
        ("http://LocalHost/", ""),
        ("http://[::1]:8080/", ""),
        ("http://me:secret@cam/", ""),
        ("http://cam/shot", "http://cam/shot"),
        ("/webcam/?action=snapshot", "/webcam/?action=snapshot"),
    ],
)
def test_a_snapshot_that_others_can_fetch(snapshot, told):
    assert webcam(provided(snapshot=snapshot), True)["snapshot_url"] == told


def test_webcams_are_for_those_who_may_watch():
    rows = server_methods(lambda: [{"name": "a", "uid": "p:a"}, {"name": "b", "uid": "p:b"}], dict)
    assert len(ask(rows, "server.webcams.list")["webcams"]) == 2
    assert ask(rows, "server.webcams.get_item", uid="p:b")["webcam"]["name"] == "b"
    assert ask(rows, "server.webcams.get_item", name="a")["webcam"]["uid"] == "p:a"
    for params in ({}, {"uid": "p:c"}, {"name": "c"}):
        refused(404, ask, rows, "server.webcams.get_item", **params)
    reader = caller("PLUGIN_RRFMODEL_READ")
    assert ask(rows, "server.webcams.list", reader) == {"webcams": []}
    refused(404, ask, rows, "server.webcams.get_item", reader, uid="p:b")


# the server


def test_where_there_is_nothing_lists_are_empty():
    rows = server_methods(list, dict)
    assert ask(rows, "server.announcements.list") == {"entries": [], "feeds": []}
    assert ask(rows, "server.job_queue.status")["queued_jobs"] == []
    assert ask(rows, "server.sensors.list") == {"sensors": {}}
    assert ask(rows, "server.temperature_store") == {}
    store = ask(rows, "server.config")["config"]["data_store"]
    assert store == {"temperature_store_size": 3600, "gcode_store_size": 1000}


def test_components_are_those_that_have_methods():
    assert components_of(Methods([])) == []
    rows = [Method("server.database.list", dict), Method("server.history.list", dict)]
    assert components_of(Methods(rows)) == ["database", "history"]


# the printer


def test_endstops_and_commands_in_words():
    status = {"query_endstops": {"last_query": {"x": 1, "y": 0}}}
    objects = SimpleNamespace(
        query=lambda wanted: {"status": {each: status[each] for each in wanted}},
        help_texts=lambda: {"G28": "Home axes"},
    )
    rows = printer_methods(objects, None, None, websocket_count=int)
    assert ask(rows, "printer.query_endstops.status") == {"x": "TRIGGERED", "y": "open"}
    assert ask(rows, "printer.gcode.help") == {"G28": "Home axes"}
    status["query_endstops"] = {}
    assert ask(rows, "printer.query_endstops.status") == {}


def refusing(sentence):
    def run(script, caller):
        raise RequestRefused(409, sentence)

    return SimpleNamespace(run=run)


def test_a_script_that_is_refused_is_told_to_all():
    told = []
    rows = printer_methods(
        None, refusing("Not now."), None, websocket_count=int, refused=told.append
    )
    with pytest.raises(RequestRefused, match="Not now"):
        ask(rows, "printer.gcode.script", script="G28")
    assert told == ["Not now."]


def test_errors_that_the_printer_said_are_marked():
    said = [("Error: no", "command"), ("Error: no", "response"), ("all is well", "response")]
    lines = [{"message": text, "time": 1.0, "type": kind} for text, kind in said]
    rows = printer_methods(
        None, None, SimpleNamespace(latest=lambda count: lines), websocket_count=int
    )
    found = ask(rows, "server.gcode_store")["gcode_store"]
    assert [line["message"] for line in found] == ["Error: no", "!! Error: no", "all is well"]


# the computer


def test_the_computer():
    rows = machine_methods(None, computer.Statistics(lambda: None), websocket_count=lambda: 3)
    info = ask(rows, "machine.system_info")["system_info"]
    assert info["cpu_info"]["total_memory"] > 1000
    assert info["distribution"]["name"]
    assert (info["available_services"], info["network"]) == ([], {})
    stats = ask(rows, "machine.proc_stats")
    assert stats["websocket_connections"] == 3
    assert stats["throttled_state"] is None
    assert stats["system_uptime"] > 0
    assert stats["moonraker_stats"][0]["memory"] > 1000
    assert stats["system_cpu_usage"].keys() >= {"cpu", "cpu0"}
    json.dumps([info, stats], allow_nan=False)
    assert ask(rows, "machine.update.status")["version_info"] == {}


def test_bandwidth_is_what_has_passed_since(monkeypatch):
    counted = SimpleNamespace(
        **dict.fromkeys(
            ["errin", "errout", "dropin", "dropout", "packets_recv", "packets_sent"], 0
        ),
        bytes_recv=1000,
        bytes_sent=500,
    )
    monkeypatch.setattr(computer.psutil, "net_io_counters", lambda pernic: {"eth0": counted})
    now = 100.0
    statistics = computer.Statistics(lambda: 0x50005, lambda: now)
    assert statistics.statistics(0)["network"]["eth0"]["bandwidth"] == 0.0
    now, counted.bytes_recv = 102.0, 3000
    found = statistics.statistics(0)
    assert found["network"]["eth0"]["bandwidth"] == 1000.0
    assert found["throttled_state"]["flags"] == [
        "Under-Voltage Detected",
        "Currently Throttled",
        "Previously Under-Volted",
        "Previously Throttled",
    ]


def test_shares_are_of_no_instant():
    now = 100.0
    statistics = computer.Statistics(lambda: None, lambda: now)
    first = statistics.statistics(1)
    now = 100.4
    again = statistics.statistics(2)
    assert again["moonraker_stats"] == first["moonraker_stats"]
    assert again["websocket_connections"] == 2
    for now in (100.5, 10.0):
        assert statistics.statistics(2)["moonraker_stats"][0]["time"] == now


def test_news_of_the_computer_are_one_sample():
    statistics = computer.Statistics(lambda: 0)
    news = statistics.news(3)
    assert news["websocket_connections"] == 3
    assert news["moonraker_stats"]["memory"] > 1000
    assert not {"throttled_state", "system_uptime"} & set(news)
    assert {"cpu_temp", "network", "system_cpu_usage", "system_memory"} < set(news)


@pytest.mark.parametrize("bits, told", [(None, None), (-1, None), (0, {"bits": 0, "flags": []})])
def test_throttled(bits, told):
    assert computer.throttled_state(bits) == told


def test_os_release():
    text = "# a comment\nID=debian\nPRETTY_NAME=\"Debian 12 (bookworm)\"\nEMPTY=\n\nno\nA='b=c'\n"
    assert computer.os_release(text) == {
        "ID": "debian",
        "PRETTY_NAME": "Debian 12 (bookworm)",
        "A": "b=c",
    }


@pytest.mark.parametrize(
    "name",
    ["machine.reboot", "machine.shutdown", "machine.services.restart", "server.restart"]
    + ["server.logs.rollover"],
)
def test_what_is_octoprints_is_refused(name):
    rows = machine_methods(None, None, websocket_count=int)
    assert "OctoPrint" in refused(403, ask, rows, name)


# power


class Power:
    """Power devices of a machine and of PSUControl, both on."""

    def __init__(self, psu=None, state=True):
        self.state, self.print_state, self.sent = {"atxPower": state}, "standby", []
        plugins = SimpleNamespace(get_helpers=lambda name, *names: psu)
        self.devices = PowerDevices(
            lambda: {"state": self.state},
            self.command,
            lambda: plugins,
            print_state=lambda: self.print_state,
        )
        self.rows = machine_methods(self.devices, None, websocket_count=int)

    def command(self, name, **parameters):
        if not parameters["on"] and self.print_state == "printing":
            raise ValueError("Not while it prints.")
        self.sent.append((name, parameters))

    def ask(self, name, **params):
        return ask(self.rows, f"machine.device_power.{name}", **params)


def psu_control(switched):
    return {
        "turn_psu_on": lambda: switched.append(True),
        "turn_psu_off": lambda: switched.append(False),
        "get_psu_state": lambda: (switched or [True])[-1],
    }


@pytest.mark.parametrize("psu", [None, {}, {"get_psu_state": bool}], ids=repr)
@pytest.mark.parametrize("state", [None, "on", 1])
def test_no_device(psu, state):
    power = Power(psu, state)
    assert power.ask("devices") == {"devices": []}
    refused(404, power.ask, "get_device", device="machine")
    assert power.devices.news() == ()


def test_the_supply_of_the_machine():
    power = Power()
    assert power.ask("devices")["devices"] == [
        {
            "device": "machine",
            "status": "on",
            "locked_while_printing": True,
            "type": "klipper_device",
        }
    ]
    assert power.ask("get_device", device="machine") == {"machine": "on"}
    assert power.devices.news() == ()
    # what becomes of it is told later
    assert power.ask("post_device", device="machine", action="toggle") == {"machine": "on"}
    assert power.sent == [("power", {"on": False})]
    power.state["atxPower"] = False
    ((method, (told,)),) = power.devices.news()
    assert (method, told["device"], told["status"]) == ("notify_power_changed", "machine", "off")
    assert power.devices.news() == ()
    power.state = {}
    assert power.devices.news() == ()


def test_the_supply_of_psucontrol():
    switched = []
    power = Power(psu_control(switched), None)
    assert power.ask("get_device", device="PSUControl") == {"PSUControl": "on"}
    assert power.ask("post_device", device="PSUControl", action="off") == {"PSUControl": "off"}
    assert power.ask("post_device", device="PSUControl", action="toggle") == {"PSUControl": "on"}
    assert switched == [False, True]


@pytest.mark.parametrize("device", ["machine", "PSUControl"])
def test_no_supply_is_switched_off_during_a_print(device):
    switched = []
    power = Power(psu_control(switched))
    power.print_state = "printing"
    refused(409, power.ask, "post_device", device=device, action="off")
    assert switched == power.sent == []


def test_several_devices_by_their_names():
    switched = []
    power = Power(psu_control(switched))
    both = dict.fromkeys(("machine", "PSUControl"))
    assert power.ask("status", **both) == {"machine": "on", "PSUControl": "on"}
    # as KlipperScreen switches them
    assert power.ask("off", PSUControl=None) == {"PSUControl": "off"}
    assert power.ask("on", **both) == {"machine": "on", "PSUControl": "on"}
    assert switched == [False, True]
    assert power.sent == [("power", {"on": True})]
    for name in ("status", "off"):
        refused(404, power.ask, name, machine=None, toaster=None)
        refused(400, power.ask, name)
    assert power.sent == [("power", {"on": True})]
    with pytest.raises(RequestRefused):
        ask(power.rows, "machine.device_power.on", caller("PLUGIN_RRFMODEL_READ"), machine=None)


def test_switching_takes_what_it_takes():
    power = Power(psu_control([]))
    refused(400, power.ask, "post_device", device="machine", action="off now")
    refused(400, power.ask, "post_device", device="machine")
    refused(404, power.ask, "post_device", device="toaster", action="on")
    with pytest.raises(RequestRefused) as error:
        ask(power.rows, "machine.device_power.post_device", caller("PLUGIN_RRFMODEL_READ"))
    assert error.value.status == 403
    assert power.sent == []


# access


def test_a_token_holds_once_and_for_five_seconds():
    now = 100.0
    tokens = OneshotTokens(lambda: now)
    one, other = tokens.issue("somebody"), tokens.issue("somebody else")
    assert one != other and len(one) == 32
    assert tokens.redeem(one) == "somebody"
    assert tokens.redeem(one) is None
    now += SECONDS
    assert tokens.redeem(other) is None
    assert tokens.redeem("") is None


def test_tokens_are_bounded():
    tokens = OneshotTokens(lambda: 1.0)
    issued = [tokens.issue(number) for number in range(MOST_TOKENS + 1)]
    assert tokens.redeem(issued[0]) is None
    assert [tokens.redeem(each) for each in issued[1:]] == list(range(1, MOST_TOKENS + 1))


def test_tokens_are_for_those_who_are_somebody():
    tokens = OneshotTokens()
    rows = access_methods(tokens)
    somebody = caller("PLUGIN_RRFMODEL_READ", lasting=lambda: somebody)
    assert tokens.redeem(ask(rows, "access.oneshot_token", somebody)) is somebody
    guest = caller("PLUGIN_RRFMODEL_READ", lasting=lambda: None)
    refused(403, ask, rows, "access.oneshot_token", guest)
    refused(403, ask, rows, "access.oneshot_token", caller(lasting=lambda: somebody))


def test_who_is_asking():
    rows = access_methods(None)
    assert ask(rows, "access.get_user") == {
        "username": "somebody",
        "source": "octoprint",
        "created_on": None,
    }
    guest = caller("PLUGIN_RRFMODEL_READ", name=None)
    assert ask(rows, "access.get_user", guest)["source"] is None
    assert ask(rows, "access.info")["trusted"] is True
    assert ask(rows, "access.info", caller())["login_required"] is True
    refused(403, ask, rows, "access.login", caller(), username="a", password="b")
    refused(403, ask, rows, "access.get_user", caller())


# the connection


class Asking:
    """A call's socket, which notes the key that it is to act for."""

    def __init__(self):
        self.socket = self
        self.id = 7
        self.keys = []

    def act_for(self, key):
        self.keys.append(key)


def test_a_client_says_who_it_is():
    asking = Asking()
    told = {"client_name": "a", "version": "1", "type": "web", "url": "http://a"}
    identify = "server.connection.identify"
    assert ask(connection_methods(), identify, socket=asking, **told) == {"connection_id": 7}
    assert ask(connection_methods(), identify, socket=asking, api_key="") == {"connection_id": 7}
    assert asking.keys == []
    ask(connection_methods(), identify, socket=asking, **told, api_key="key")
    assert asking.keys == ["key"]
    assert ask(connection_methods(), "server.websocket.id", socket=asking) == {"websocket_id": 7}


@pytest.mark.parametrize(
    "status, params",
    [
        (400, {"client_name": 1}),
        (400, {"version": []}),
        (400, {"type": "toaster"}),
        (400, {"type": {}}),
        (400, {"api_key": 5}),
        (403, {"access_token": "a"}),
    ],
    ids=repr,
)
def test_a_client_that_says_it_wrong(status, params):
    asking = Asking()
    refused(
        status, ask, connection_methods(), "server.connection.identify", socket=asking, **params
    )
    assert asking.keys == []


@pytest.mark.parametrize("name", ["server.connection.identify", "server.websocket.id"])
def test_over_http_there_is_no_connection(name):
    assert "websocket" in refused(400, ask, connection_methods(), name)
