"""The mainboards the simulated machines are built on: names, limits, number of buffers."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ..firmware import Firmware

DUET3_BUFFERS = 40


@dataclass(frozen=True)
class Mainboard:
    """One mainboard as its firmware reports it."""

    name: str
    short_name: str
    firmware_name: str
    electronics: str
    """``ELECTRONICS`` of M115."""
    firmware_file: str
    drivers: int
    heaters: int
    queue_length: int
    """Moves that fit in the movement queue."""
    limits: dict[str, int] = field(default_factory=dict)
    is_duet2: bool = False
    has_v12: bool = False
    wifi: bool = True
    driver_status: int = 0
    unique_id: str = ""

    def buffers(self, firmware: Firmware) -> int:
        """Return the number of output buffers (RRF 3.5 Configuration.h:173)."""
        return firmware.duet2_buffers if self.is_duet2 else DUET3_BUFFERS

    def model(self, firmware: Firmware) -> dict[str, Any]:
        """Return ``boards[0]``."""
        members: dict[str, Any] = {
            "accelerometer": None,
            "canAddress": None if self.is_duet2 else 0,
            "directDisplay": None,
            "drivers": [{"status": self.driver_status} for _ in range(self.drivers)],
            "firmwareDate": firmware.date,
            "firmwareFileName": self.firmware_file,
            "firmwareName": self.firmware_name,
            "firmwareVersion": firmware.version,
            "freeRam": 26112 if self.is_duet2 else 118392,
            "iapFileNameSBC": None if self.is_duet2 else f"Duet3_SBCiap32_{self.short_name}.bin",
            "iapFileNameSD": f"Duet3_SDiap32_{self.short_name}.bin",
            "maxHeaters": self.heaters,
            "maxMotors": self.drivers,
            "mcuTemp": {"current": 36.8, "max": 38.4, "min": 21.2},
            "name": self.name,
            "shortName": self.short_name,
            "supportsDirectDisplay": self.short_name == "Mini5plus",
            "uniqueId": self.unique_id,
            "v12": {"current": 12.2, "max": 12.3, "min": 12.1} if self.has_v12 else None,
            "vIn": {"current": 24.1, "max": 24.3, "min": 23.8},
            "wifiFirmwareFileName": "DuetWiFiServer.bin" if self.wifi else None,
        }
        if self.is_duet2:
            del members["canAddress"], members["iapFileNameSBC"]
        return members


def _limits(**differing: int) -> dict[str, int]:
    limits = {
        "axes": 10,
        "axesPlusExtruders": 12,
        "bedHeaters": 4,
        "boards": 5,
        "chamberHeaters": 4,
        "drivers": 14,
        "driversPerAxis": 4,
        "extruders": 8,
        "extrudersPerTool": 8,
        "fans": 20,
        "gpInPorts": 32,
        "gpOutPorts": 32,
        "heaters": 32,
        "heatersPerTool": 4,
        "ledStrips": 5,
        "monitorsPerHeater": 3,
        "portsPerHeater": 2,
        "restorePoints": 6,
        "sensors": 56,
        "spindles": 4,
        "tools": 50,
        "trackedObjects": 40,
        "triggers": 32,
        "volumes": 2,
        "workplaces": 9,
        "zProbeProgramBytes": 8,
        "zProbes": 4,
    }
    limits.update(differing)
    return limits


MINI5PLUS = Mainboard(
    "Duet 3 Mini 5+",
    "Mini5plus",
    "RepRapFirmware for Duet 3 Mini 5+",
    "Duet 3 Mini5plus WiFi",
    "Duet3Firmware_Mini5plus.uf2",
    drivers=7,
    heaters=32,
    queue_length=40,
    limits=_limits(fans=32, gpInPorts=56, gpOutPorts=64, heatersPerTool=2, triggers=16),
    unique_id="SIM01-5Q7KM-N2R3D-4TL0S-6S21B-1MNR1",
)
MB6HC = Mainboard(
    "Duet 3 MB6HC",
    "MB6HC",
    "RepRapFirmware for Duet 3 MB6HC",
    "Duet 3 MB6HC v1.02 or later",
    "Duet3Firmware_MB6HC.bin",
    drivers=6,
    heaters=32,
    queue_length=60,
    limits=_limits(axes=15, axesPlusExtruders=25, bedHeaters=12, boards=21, drivers=26),
    has_v12=True,
    wifi=False,
    unique_id="SIM02-956L2-G43S8-6J1F2-3SJ6T-KA56G",
)
MB6XD = Mainboard(
    "Duet 3 MB6XD",
    "MB6XD",
    "RepRapFirmware for Duet 3 MB6XD",
    "Duet 3 MB6XD v1.01 or later",
    "Duet3Firmware_MB6XD.bin",
    drivers=6,
    heaters=32,
    queue_length=60,
    limits=_limits(axes=15, axesPlusExtruders=25, bedHeaters=12, boards=21, drivers=26),
    has_v12=True,
    wifi=False,
    unique_id="SIM03-T6GZ1-8R0X4-7KD2P-1VY5N-Q3HM8",
)
DUET2_WIFI = Mainboard(
    "Duet 2 WiFi",
    "2WiFi",
    "RepRapFirmware for Duet 2 WiFi/Ethernet",
    "Duet WiFi 1.02 or later",
    "Duet2CombinedFirmware.bin",
    drivers=12,
    heaters=16,
    queue_length=40,
    limits=_limits(heaters=16, drivers=12, boards=1, ledStrips=2, heatersPerTool=2, gpInPorts=16),
    is_duet2=True,
    driver_status=3284205568,
    unique_id="SIM04-08K1B-9B6BA-KDFQ4-7L62R-ANY2C",
)

EXPANSION_DATE = "2024-09-30 15:47:52"


def toolboard(address: int, firmware: Firmware) -> dict[str, Any]:
    """Return a CAN-connected tool board, an element of ``boards`` from index 1 on."""
    return {
        "accelerometer": {"orientation": 20, "points": 0, "runs": 0},
        "canAddress": address,
        "closedLoop": None,
        "drivers": [{"status": 0}],
        "firmwareDate": EXPANSION_DATE,
        "firmwareFileName": "Duet3Firmware_TOOL1LC.bin",
        "firmwareVersion": firmware.version,
        "freeRam": 3884,
        "inductiveSensor": None,
        "maxMotors": 1,
        "mcuTemp": {"current": 41.3, "max": 44.0, "min": 22.9},
        "name": "Duet 3 Expansion TOOL1LC",
        "shortName": "TOOL1LC",
        "state": "running",
        "uniqueId": f"SIM{address}-0JD2M-K1ML1-401QS-TG1C8-90DXK",
        "v12": None,
        "vIn": {"current": 23.9, "max": 24.1, "min": 23.7},
    }
