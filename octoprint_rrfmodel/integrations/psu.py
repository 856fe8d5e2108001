"""The machine's power supply, as PSUControl's sub-plugins have it: M80, M81, and the model."""

METHODS = ("turn_psu_on", "turn_psu_off", "get_psu_state")
"""What PSUControl calls on what has registered (its extra/psucontrol_subpluginexample.py)."""


HELPERS = ("turn_psu_on", "turn_psu_off", "get_psu_state")
"""What PSUControl offers to others; the state is the one that it knows, nothing is asked for it."""

PERMISSION = "PLUGIN_PSUCONTROL_CONTROL"
"""PSUControl's own permission to switch."""


class PowerSupply:
    """Switches the supply and knows its state; returns at once, whoever calls.

    ``command(name, **parameters)`` queues a command and raises ``ValueError`` with a sentence
    where it is refused; PSUControl logs that and takes the supply for as it was. ``model()`` is
    the snapshot.
    """

    def __init__(self, command, model):
        self._command = command
        self._model = model

    def turn_psu_on(self):
        """Queue what switches the supply on."""
        self._command("power", on=True)

    def turn_psu_off(self):
        """Queue what switches the supply off; refused while something is printed."""
        self._command("power", on=False)

    def get_psu_state(self):
        """Return True while the supply is on; False also where the machine doesn't tell.

        It doesn't without a port for the supply (M80 C), and while no machine is connected.
        """
        return (self._model().get("state") or {}).get("atxPower") is True


def psu_control(plugin_manager):
    """Return PSUControl's helpers by name, empty where that plugin isn't there."""
    helpers = plugin_manager.get_helpers("psucontrol", *METHODS) or {}
    return helpers if helpers.keys() >= set(METHODS) else {}


def register(plugin_manager, plugin, supply):
    """Offer the supply to PSUControl; return whether that plugin is there and takes it.

    PSUControl finds a name for what registers by looking for that very object among OctoPrint's
    plugins, so that the plugin itself has to have the methods.
    """
    helpers = plugin_manager.get_helpers("psucontrol", "register_plugin") or {}
    if "register_plugin" not in helpers:
        return False
    for name in METHODS:
        setattr(plugin, name, getattr(supply, name))
    helpers["register_plugin"](plugin)
    return True
