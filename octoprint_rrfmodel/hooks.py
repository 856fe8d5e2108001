"""Which part of the plugin answers which of OctoPrint's hooks."""

from .host.permissions import permissions
from .integrations.octoprint_events import custom_events

BEFORE_ALL = -1000
"""Order of the hook about what comes in: others, of whatever order (Octolapse's is -1), are to read
clean lines, and in words that they know. All others have none: OctoPrint takes them by name."""


def hooks_of(plugin):
    """Return OctoPrint's hooks and who handles them."""
    parts = plugin.parts
    port, received = parts.simulated_port, parts.received
    return {
        "octoprint.comm.protocol.gcode.received": (received.on_received, BEFORE_ALL),
        "octoprint.comm.protocol.gcode.queuing": parts.queued.on_queuing,
        "octoprint.comm.protocol.gcode.sending": parts.sent.on_sending,
        "octoprint.comm.protocol.gcode.error": received.on_error,
        "octoprint.comm.protocol.firmware.info": received.on_firmware_info,
        "octoprint.comm.protocol.temperatures.received": parts.display.on_temperatures,
        "octoprint.comm.transport.serial.factory": port.open,
        "octoprint.comm.transport.serial.additional_port_names": port.names,
        "octoprint.plugin.softwareupdate.check_config": plugin.update_check,
        "octoprint.printer.sdcardupload": parts.uploads.on_upload,
        "octoprint.server.api.before_request": plugin.before_request,
        "octoprint.server.http.bodysize": plugin.body_sizes,
        "octoprint.server.http.routes": plugin.routes,
        "octoprint.server.sockjs.emit": parts.terminal.on_emit,
        "octoprint.access.permissions": permissions,
        "octoprint.events.register_custom_events": custom_events,
    }
