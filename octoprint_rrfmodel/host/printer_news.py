"""What OctoPrint tells of its printer, for all of the plugin at once."""

from octoprint.printer import PrinterCallback


class PrinterNews(PrinterCallback):
    """Hands on the state of OctoPrint's job, and each line of its log.

    OctoPrint asks each callback about both, on the threads that a print waits for: one callback
    whose methods are those that work costs a line of a print two calls, not four.
    """

    def __init__(self, *, current_data, log):
        self.on_printer_send_current_data = current_data
        self.on_printer_add_log = log
