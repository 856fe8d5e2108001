"""What can be switched on and off: the machine's own supply and PSUControl's, as power devices."""

from typing import Any, Callable, NamedTuple

from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ...host.answers import RequestRefused
from ...integrations import psu
from ...rrf.views.machine import mapping

ACTIONS = ("on", "off", "toggle")

PRINTS = ("printing", "paused")
"""States of a print in which no supply is switched off."""


class Device(NamedTuple):
    """One of them: its state now, and what switches it."""

    is_on: bool
    kind: str
    switch: Callable[[bool], Any]
    """Takes what it is to be; raises ``ValueError`` with a sentence."""
    permission: str = ""
    """What the user needs beside CONTROL; empty for nothing."""


class PowerDevices:
    """Knows the devices and switches them.

    ``model()`` is the snapshot, ``command(name, **parameters)`` queues a command of the machine or
    raises ``ValueError``. ``plugins()`` is OctoPrint's plugin manager, ``print_state()`` Klipper's
    word for the state of the print.
    """

    def __init__(self, model, command, plugins, *, print_state):
        self._model = model
        self._command = command
        self._plugins = plugins
        self._print_state = print_state
        self._shown = set()
        """What clients may take the machine's supply for."""

    def listed(self):
        """Return all devices in Moonraker's form."""
        return [_listed(name, device) for name, device in self._devices().items()]

    def state(self, name):
        """Return a device's state by its name."""
        return {name: _word(self._device(name).is_on)}

    def switch(self, name, action, caller):
        """Switch a device and return its state.

        Of the machine that is the one now: what has become of it is told to the sockets. PSUControl
        looks again only later; of that it is the one it was told to have.
        """
        if action not in ACTIONS:
            raise RequestRefused(400, gettext("A device is switched on, off, or with toggle."))
        device = self._device(name)
        if device.permission and not caller.may(device.permission):
            raise RequestRefused(403, gettext("You may not do that. Ask an administrator."))
        wanted = not device.is_on if action == "toggle" else action == "on"
        try:
            now = device.switch(wanted)
        except ValueError as error:
            raise RequestRefused(409, str(error)) from None
        return {name: _word(now)}

    def news(self):
        """Return notifications about the machine's supply, which its model tells; never waits."""
        device = self._machine()
        if device is None:
            return ()
        # others may be shown it meanwhile
        shown, self._shown = self._shown, {device.is_on}
        is_news = shown - {device.is_on}
        return (("notify_power_changed", [_listed(MACHINE, device)]),) if is_news else ()

    def _device(self, name):
        device = self._devices().get(name)
        if device is None:
            raise RequestRefused(404, gettext("There is no such device."))
        return device

    def _devices(self):
        machine = self._machine()
        if machine is not None:
            self._shown.add(machine.is_on)
        found = {MACHINE: machine, PSU_CONTROL: self._psu_control()}
        return {name: device for name, device in found.items() if device is not None}

    def _machine(self):
        """Return the supply that M80 and M81 switch, ``None`` where the model knows of none."""
        is_on = self._is_machine_on()
        return None if is_on is None else Device(is_on, "klipper_device", self._switch_machine)

    def _switch_machine(self, on):
        self._command("power", on=on)
        return self._is_machine_on()

    def _is_machine_on(self):
        is_on = mapping(self._model().get("state")).get("atxPower")
        return is_on if isinstance(is_on, bool) else None

    def _psu_control(self):
        helpers = psu.psu_control(self._plugins())
        if not helpers:
            return None
        permission = psu.PERMISSION if Permissions.find(psu.PERMISSION) is not None else ""
        return Device(
            helpers["get_psu_state"]() is True,
            "octoprint",
            lambda on: self._switch_psu(helpers, on),
            permission,
        )

    def _switch_psu(self, helpers, on):
        if not on and self._print_state() in PRINTS:
            raise ValueError(gettext("The supply is not switched off during a print."))
        helpers["turn_psu_on" if on else "turn_psu_off"]()
        return on


MACHINE = "machine"
PSU_CONTROL = "PSUControl"
"""Names of the devices."""


def _word(is_on):
    return "on" if is_on else "off"


def _listed(name, device):
    return {
        "device": name,
        "status": _word(device.is_on),
        "locked_while_printing": True,
        "type": device.kind,
    }
