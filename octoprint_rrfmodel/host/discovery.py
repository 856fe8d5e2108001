"""OctoPrint's own plugin for being found on the network, as far as others go by it."""

PLUGIN = "discovery"


def addresses_of_discovery(plugins):
    """Return the host's addresses at which OctoPrint lets itself be found; none if it doesn't.

    ``plugins`` is the plugin manager. May wait for the host's network.
    """
    found = plugins.get_plugin_info(PLUGIN, require_enabled=True)
    addresses = getattr(getattr(found, "implementation", None), "get_interface_addresses", None)
    return list(addresses()) if addresses is not None else []
