"""A plugin with the hooks of a printer's dialect, which do nothing: what any such plugin costs."""

__plugin_name__ = "Empty hooks"
__plugin_pythoncompat__ = ">=3.9,<4"


def on_received(comm, line, *args, **kwargs):
    return line


def on_command(comm, phase, cmd, cmd_type, gcode, subcode=None, tags=None, *args, **kwargs):
    return None


__plugin_hooks__ = {
    "octoprint.comm.protocol.gcode.received": on_received,
    "octoprint.comm.protocol.gcode.queuing": on_command,
    "octoprint.comm.protocol.gcode.sending": on_command,
}
