"""Methods by which the board is restarted, as after an emergency stop."""

from .methods import CONTROL, Method


def restart_methods(commands):
    """Return the rows; ``commands`` are those to the machine (``MachineCommands``)."""

    def restart(call):
        commands.checked("recover", {})
        commands.run("recover", {})
        return "ok"

    names = ("printer.restart", "printer.firmware_restart")
    return tuple(Method(name, restart, CONTROL, ("POST",)) for name in names)
