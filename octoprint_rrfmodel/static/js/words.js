/* Words in the page's language and values as people read them. */
$(function () {
    /** Words in the page's language; OctoPrint defines gettext after this file has run. */
    RRFModel.makeWords = () => ({
        /** Sub-views of the tab. */
        view: {
            machine: gettext("Machine"),
            job: gettext("Job"),
            chart: gettext("Chart"),
            model: gettext("Model")
        },
        /** The machine's state, by state.status; a new one is shown as it came. */
        status: {
            starting: gettext("Starting"),
            updating: gettext("Updating the firmware"),
            halted: gettext("Halted"),
            off: gettext("No motor supply"),
            pausing: gettext("Pausing"),
            resuming: gettext("Resuming"),
            paused: gettext("Paused"),
            cancelling: gettext("Cancelling"),
            simulating: gettext("Simulating"),
            processing: gettext("Printing from its card"),
            changingTool: gettext("Changing the tool"),
            busy: gettext("Busy"),
            idle: gettext("Idle")
        },
        /** A heater's state: word and label class. */
        heater: {
            off: {text: gettext("off"), label: ""},
            standby: {text: gettext("standby"), label: "label-info"},
            active: {text: gettext("active"), label: "label-success"},
            fault: {text: gettext("fault"), label: "label-important"},
            tuning: {text: gettext("tuning"), label: "label-warning"},
            offline: {text: gettext("offline"), label: "label-warning"}
        },
        blocked: {
            heating: gettext("the printer waits for a temperature"),
            long_command: gettext("the printer is busy with a long command"),
            streaming: gettext("a file is being sent to the printer's card"),
            buffers: gettext("the printer is short of memory for its answers")
        },
        /** What a person is told, by the code of a warning; others have the server's text. */
        warning: {
            halted: gettext(
                "The machine was stopped by an emergency stop. Restart it with M999 or its power switch."
            ),
            off: gettext("The motors have no supply voltage."),
            reset: gettext(
                "The board was reset during the print, which can't go on. Cancel it, then home."
            ),
            message_box_unanswerable: gettext(
                "The machine waits for an answer that this firmware does not take over USB. Answer on the machine's own page or panel, or reset the machine."
            ),
            long_running_commands: gettext(
                "OctoPrint does not know some of RepRapFirmware's commands that take long."
            ),
            uppercase: gettext(
                "OctoPrint's terminal would change file names and texts to upper case."
            ),
            unknown_commands: gettext(
                "OctoPrint does not count the acknowledgements of T-1 and of commands such as echo."
            ),
            external_heatup: gettext(
                "OctoPrint would take RepRapFirmware's temperature reports for a heat-up."
            ),
            profile_tools: gettext(
                "The printer profile has fewer extruders than the machine's highest tool number needs, so that OctoPrint drops tool commands."
            ),
            profile_reconnect: gettext(
                "Disconnect the printer and connect it again: OctoPrint still uses the old number of extruders."
            )
        },
        numbered: {
            heater_fault: gettext(
                "Heater %(number)s reports a fault. Find the cause, then reset it with M562."
            ),
            filament_error: gettext(
                "The filament monitor of extruder %(number)s reports an error. Check the filament."
            ),
            driver_error: gettext(
                "Motor driver %(number)s reports an error. Find the cause."
            )
        },
        /** What the button of a warning says, by the command that it sends. */
        fix: {
            recover: gettext("Restart the machine"),
            fix_settings: gettext("Set OctoPrint's settings"),
            fix_profile: gettext("Raise the number of extruders")
        }
    });

    const isNumber = (value) => typeof value === "number";

    /** Values as people read them; what is not known is a dash. */
    RRFModel.show = {
        degrees: (value) => (isNumber(value) ? value.toFixed(1) : "–"),

        /** A target: one that was never set is -273.15. */
        target: (value) => (isNumber(value) && value > -273 ? value.toFixed(0) : "–"),

        fixed: (value, digits) => (isNumber(value) ? value.toFixed(digits) : "–"),

        /** A fraction as whole percent. */
        percent: (value) => (isNumber(value) ? Math.round(value * 100) + " %" : "–"),

        /** Seconds as hours, minutes and seconds. */
        duration: function (seconds) {
            if (!isNumber(seconds) || seconds < 0) return "–";
            const whole = Math.round(seconds);
            const two = (number) => String(number).padStart(2, "0");
            const text = two(Math.floor(whole / 60) % 60) + ":" + two(whole % 60);
            return Math.floor(whole / 3600) + ":" + text;
        }
    };
});
