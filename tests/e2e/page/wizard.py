"""What a machine needs of OctoPrint: asked of the plugin, written, and taken back."""

PROFILE = "/api/printerprofiles/_default"

FIELDS = ("volume", "axes", "extruder", "heatedBed", "heatedChamber")
"""What the plugin may write of the profile."""

SHOW = "OctoPrint.coreui.viewmodels.settingsViewModel.show('#settings_plugin_rrfmodel')"
"""Opens the settings where the plugin's are."""


def setup(server):
    """Return what the plugin says is needed, and what of the profile differs."""
    response = server.get("/plugin/rrfmodel/setup")
    assert response.status_code == 200, response.text
    return response.json()


def command(server, **data):
    """Send a command to the plugin; return the response."""
    return server.post("/api/plugin/rrfmodel", json=data)
