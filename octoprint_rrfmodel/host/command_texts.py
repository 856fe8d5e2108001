"""What a person is told when a command is refused: one sentence for each code."""

from flask_babel import gettext


def command_text(code, values):
    """Return the sentence for a code of ``rrf.commands``, with its values in it."""
    return _texts()[code] % values


def _texts():
    return {**_of_requests(), **_of_things(), **_of_boxes(), **_of_states()}


def _of_requests():
    """What is wrong with a request by itself."""
    return {
        "unknown_command": gettext("There is no command %(command)s. The commands are: %(known)s."),
        "not_a_command": gettext(
            "The request has to be a JSON object with the name of a command in command."
        ),
        "unknown_parameter": gettext(
            "The command %(command)s has no parameter %(parameter)s. It has: %(known)s."
        ),
        "missing_parameter": gettext("The parameter %(parameter)s is missing."),
        "needless": gettext(
            "The parameter %(parameter)s belongs to these actions only: %(known)s."
        ),
        "one_of": gettext("Give one of these parameters: %(known)s."),
        "nothing_to_do": gettext("Give at least one of these parameters: %(known)s."),
        "not_a_number": gettext("The parameter %(parameter)s has to be a number."),
        "not_whole": gettext("The parameter %(parameter)s has to be a whole number."),
        "not_a_truth_value": gettext("The parameter %(parameter)s has to be true or false."),
        "not_a_text": gettext("The parameter %(parameter)s has to be a text."),
        "neither": gettext("The parameter %(parameter)s has to be a number or a text."),
        "not_letters": gettext("The parameter %(parameter)s has to be a list of axis letters."),
        "not_moves": gettext(
            "The parameter %(parameter)s has to be an object with millimetres for each axis letter."
        ),
        "wrong_word": gettext("The parameter %(parameter)s has to be one of: %(known)s."),
        "out_of_range": gettext("The parameter %(parameter)s has to be from %(low)s to %(high)s."),
        "wrong_length": gettext(
            "The parameter %(parameter)s must not be empty and may have at most %(most)s bytes."
        ),
        "unsendable": gettext(
            "The parameter %(parameter)s has a line break, a control character or a semicolon in"
            " it, which can't be sent. Take it out."
        ),
        "not_a_file": gettext("The parameter %(parameter)s has to be the path of a file."),
        "filament_name": gettext(
            "The parameter %(parameter)s must not have commas or slashes in it."
        ),
        "line_too_long": gettext(
            "The command would be longer than the %(most)s bytes that the firmware reads. Use"
            " shorter texts."
        ),
    }


def _of_things():
    """What the machine has not got, or what is outside of its limits."""
    return {
        "no_such_key": gettext("The model has no key %(key)s."),
        "no_such_tool": gettext("The machine has no tool %(value)s. Its tools are: %(known)s."),
        "no_such_bed": gettext("The machine has no heated bed %(value)s. Its beds are: %(known)s."),
        "no_such_chamber": gettext(
            "The machine has no heated chamber %(value)s. Its chambers are: %(known)s."
        ),
        "no_such_heater": gettext(
            "The machine has no heater %(value)s. Its heaters are: %(known)s."
        ),
        "no_such_fan": gettext("The machine has no fan %(value)s. Its fans are: %(known)s."),
        "no_such_axis": gettext(
            "The machine has no axis %(value)s. Its axes are: %(known)s. Upper and lower case"
            " differ."
        ),
        "no_such_extruder": gettext(
            "The machine has no extruder %(value)s. Its extruders are: %(known)s."
        ),
        "no_such_spindle": gettext(
            "The machine has no spindle %(value)s. Its spindles are: %(known)s."
        ),
        "no_such_probe": gettext("The machine has no probe %(value)s. Its probes are: %(known)s."),
        "no_such_output": gettext(
            "The machine has no output %(value)s. Its outputs are: %(known)s."
        ),
        "no_such_strip": gettext(
            "The machine has no LED strip %(value)s. Its strips are: %(known)s."
        ),
        "no_such_board": gettext("The machine has no board %(value)s. Its boards are: %(known)s."),
        "no_such_variable": gettext(
            "The machine has no variable %(value)s. Its variables are: %(known)s."
        ),
        "cannot_reverse": gettext("Spindle %(spindle)s turns in one direction only."),
        "no_such_object": gettext("The print has no object %(value)s. Its objects are: %(known)s."),
        "temperature": gettext(
            "The parameter %(parameter)s has to be above %(low)s °C and below %(high)s °C, the"
            " limits of the heater."
        ),
        "outside": gettext("Axis %(axis)s has to be from %(low)s mm to %(high)s mm."),
        "no_heater": gettext("Tool %(tool)s has no heater."),
        "wrong_count": gettext(
            "The parameter %(parameter)s has to be one number or a list of %(count)s."
        ),
    }


def _of_boxes():
    """What doesn't fit the message box."""
    return {
        "no_box": gettext("No message waits for an answer."),
        "other_box": gettext(
            "That message is gone. The one that waits for an answer has the number %(seq)s."
        ),
        "unanswerable": gettext(
            "The machine waits for an answer that this firmware does not take over USB. Answer on"
            " the machine's own page or panel, or reset the machine."
        ),
        "box_answered": gettext("This message has just been answered. Wait for the next one."),
        "not_cancellable": gettext("This message can't be cancelled. Answer it with ok."),
        "box_wants_value": gettext("This message wants an answer in the parameter value."),
        "box_takes_no_value": gettext("This answer has no value. Leave the parameter value out."),
        "box_length": gettext(
            "The parameter %(parameter)s has to have from %(low)s to %(high)s characters."
        ),
    }


def _of_states():
    """What the printer's state forbids."""
    return {
        "too_many": gettext("Too many commands in a short time. Try again in a second."),
        "not_connected": gettext("No printer is connected. Connect it first."),
        "not_rrf": gettext("The connected printer has not said that it runs RepRapFirmware."),
        "no_model": gettext("The printer has not told its model yet. Try again in a few seconds."),
        "halted": gettext(
            "The machine was stopped by an emergency stop. Restart it with the command recover."
        ),
        "printing": gettext("The machine prints. Pause or cancel the print first."),
        "printing_or_paused": gettext(
            "The machine has a print. Wait for its end or cancel it first."
        ),
        "streamed": gettext(
            "OctoPrint itself sends this print. Use OctoPrint's own job API, POST /api/job."
        ),
        "not_homed": gettext("Home these axes first: %(axes)s."),
        "no_tool_selected": gettext("No tool is selected. Select one first."),
        "too_cold": gettext("Tool %(tool)s is too cold. Heat it first."),
        "no_filament_drive": gettext(
            "Tool %(tool)s has no extruder for a filament. Select another tool."
        ),
        "no_target": gettext(
            "A chamber can't be switched on without a temperature. Give it in active."
        ),
        "no_job": gettext("The machine prints no file from its card that this could be done to."),
        "not_paused": gettext("No print from the machine's card is paused."),
        "no_objects": gettext("No print with named objects is under way on the machine."),
        "not_cnc": gettext(
            "Spindles turn only while the machine is a CNC machine. Set that with M453."
        ),
        "no_power_control": gettext(
            "The machine has no power supply control. Set it up with M80 C in its config.g."
        ),
        "currents_unknown": gettext(
            "The currents of the other extruders are not known, and they are set together."
        ),
        "needs_firmware": gettext("Only RepRapFirmware %(version)s and newer can do that."),
        "tool_state_firmware": gettext(
            "Only RepRapFirmware %(version)s and newer can do that. Select the tool, or set its"
            " temperatures."
        ),
        "objects_firmware": gettext(
            "Only RepRapFirmware %(version)s and newer knows the objects of a print. Update the"
            " firmware."
        ),
    }
