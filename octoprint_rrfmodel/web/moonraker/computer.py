"""The computer that OctoPrint runs on, in Moonraker's words.

What it is called on the network and its serial numbers are nobody's business here.
"""

import os
import platform
import struct
import sys
import time
from pathlib import Path

import psutil

KILOBYTE = 1024

SHORTEST = 0.5
"""Seconds that a share is of at least; who asks sooner is told the last again."""

STAYS = ("throttled_state", "system_uptime")
"""What Moonraker leaves out of the news of each second."""

OS_RELEASE = "/etc/os-release"
BOARD = "/proc/device-tree/model"

THERMOMETERS = ("cpu_thermal", "cpu-thermal", "coretemp", "k10temp", "soc_thermal")
"""Where systems have the processor's temperature, the Raspberry Pi's first."""

THROTTLED = {
    0: "Under-Voltage Detected",
    1: "Frequency Capped",
    2: "Currently Throttled",
    3: "Temperature Limit Active",
    16: "Previously Under-Volted",
    17: "Previously Frequency Capped",
    18: "Previously Throttled",
    19: "Previously Temperature Limited",
}
"""Moonraker's words for the bits of ``vcgencmd get_throttled``."""


def system_info():
    """Return ``machine.system_info``: what stays the same."""
    release = os_release(_text(OS_RELEASE))
    return {
        "provider": "none",
        "cpu_info": {
            "cpu_count": os.cpu_count(),
            "bits": f"{struct.calcsize('P') * 8}bit",
            "processor": platform.machine(),
            "cpu_desc": platform.processor(),
            "serial_number": "",
            "hardware_desc": "",
            "model": _text(BOARD).strip("\0\n"),
            "total_memory": psutil.virtual_memory().total // KILOBYTE,
            "memory_units": "kB",
        },
        "sd_info": {},
        "distribution": {
            "name": release.get("PRETTY_NAME", platform.system()),
            "id": release.get("ID", ""),
            "version": release.get("VERSION_ID", ""),
            "version_parts": _version_parts(release.get("VERSION_ID", "")),
            "like": release.get("ID_LIKE", ""),
            "codename": release.get("VERSION_CODENAME", ""),
            "release_info": {},
        },
        "virtualization": {},
        "python": {"version": list(sys.version_info), "version_string": sys.version},
        "network": {},
        "canbus": {},
        "available_services": [],
        "service_state": {},
        "instance_ids": {"moonraker": "", "klipper": ""},
    }


class Statistics:
    """What the computer is doing; shares are those since the question before.

    ``throttled()`` gives the bits of ``vcgencmd get_throttled``, ``None`` where nobody knows.
    """

    def __init__(self, throttled, now=time.time):
        self._throttled = throttled
        self._now = now
        self._process = psutil.Process()
        self._passed = {}, self._now()
        self._told = None
        self._process.cpu_percent(None)
        psutil.cpu_percent(None)
        psutil.cpu_percent(None, percpu=True)

    def statistics(self, websocket_count):
        """Return ``machine.proc_stats``."""
        now = self._now()
        if self._told is None or not 0 <= now - self._told[0] < SHORTEST:
            self._told = now, self._measured(now)
        return {**self._told[1], "websocket_connections": websocket_count}

    def news(self, websocket_count):
        """Return what ``notify_proc_stat_update`` has: the same, of one sample."""
        told = self.statistics(websocket_count)
        changing = {name: value for name, value in told.items() if name not in STAYS}
        return {**changing, "moonraker_stats": told["moonraker_stats"][-1]}

    def _measured(self, now):
        memory = psutil.virtual_memory()
        return {
            "moonraker_stats": [
                {
                    "time": now,
                    "cpu_usage": self._process.cpu_percent(None),
                    "memory": self._process.memory_info().rss // KILOBYTE,
                    "mem_units": "kB",
                }
            ],
            "throttled_state": throttled_state(self._throttled()),
            "cpu_temp": _cpu_temperature(),
            "network": self._network(now),
            "system_cpu_usage": _cpu_usage(),
            "system_memory": {
                "total": memory.total // KILOBYTE,
                "available": memory.available // KILOBYTE,
                "used": memory.used // KILOBYTE,
            },
            "system_uptime": now - psutil.boot_time(),
        }

    def _network(self, now):
        before, asked_at = self._passed
        seconds = now - asked_at
        found = {}
        passed = {}
        for name, counted in (psutil.net_io_counters(pernic=True) or {}).items():
            passed[name] = counted.bytes_recv + counted.bytes_sent
            growth = max(0, passed[name] - before.get(name, passed[name]))
            found[name] = {
                "rx_bytes": counted.bytes_recv,
                "tx_bytes": counted.bytes_sent,
                "bandwidth": growth / seconds if seconds > 0 else 0.0,
                "rx_packets": counted.packets_recv,
                "tx_packets": counted.packets_sent,
                "rx_errs": counted.errin,
                "tx_errs": counted.errout,
                "rx_drop": counted.dropin,
                "tx_drop": counted.dropout,
            }
        self._passed = passed, now
        return found


def throttled_state(bits):
    """Return Moonraker's form of the bits, ``None`` where nobody knows."""
    if bits is None or bits < 0:
        return None
    return {"bits": bits, "flags": [word for bit, word in THROTTLED.items() if bits >> bit & 1]}


def os_release(text):
    """Return what a file in the form of ``os-release`` says."""
    lines = (line.partition("=") for line in text.splitlines() if not line.startswith("#"))
    return {name.strip(): value.strip().strip("\"'") for name, _, value in lines if value}


def _version_parts(version):
    major, _, rest = version.partition(".")
    minor, _, build = rest.partition(".")
    return {"major": major, "minor": minor, "build_number": build}


def _cpu_usage():
    each = psutil.cpu_percent(None, percpu=True)
    return {
        "cpu": psutil.cpu_percent(None),
        **{f"cpu{number}": used for number, used in enumerate(each)},
    }


def _cpu_temperature():
    # only some systems have it at all
    read = getattr(psutil, "sensors_temperatures", dict)
    found = read()
    return next((found[name][0].current for name in THERMOMETERS if found.get(name)), None)


def _text(path):
    try:
        return Path(path).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
