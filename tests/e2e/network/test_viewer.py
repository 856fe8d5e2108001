"""OctoPrint's own viewer of G-code and a print of the board's card."""

from tests.support.basedir import ADMIN
from tests.support.browser import new_context, new_page, open_octoprint

from .. import helpers
from . import bench

BOARD = {"machine": "cartesian", "speed": 10}

LAYERS = 40


def prepare(board):
    lines = ["M83", "G28", "T0"]
    for layer in range(1, LAYERS + 1):
        lines.append(f"G1 Z{layer * 0.2:.1f} F3000")
        lines += [f"G1 X{20 + n % 2 * 80} Y{20 + n} E0.5 F1500" for n in range(40)]
    board.card.write("0:/gcodes/layers.gcode", "\n".join(lines) + "\n")


VIEWER = "ko.dataFor(document.getElementById('gcode'))"

SLIDERS = f"""[
    {VIEWER}.layerSlider.slider("getValue"), {VIEWER}.layerCommandSlider.slider("getValue")[1]
]"""


def test_it_has_the_cards_file_and_follows_the_print(browser, server, face):
    server.wait_for(
        lambda: server.get("/api/files/printer/layers.gcode").ok, 60, "the file to be listed"
    )
    bench.at_panel(face, 'M32 "0:/gcodes/layers.gcode"')
    server.wait_state("Printing", 20)
    context, errors = new_context(browser), []
    page = new_page(context, errors)
    open_octoprint(page, server, ADMIN, "/#gcode")

    page.wait_for_function(f"() => {VIEWER}.loadedFilePath")
    assert page.evaluate(f"[{VIEWER}.loadedFileStorage, {VIEWER}.loadedFilePath]") == [
        "printer",
        "layers.gcode",
    ]

    def place():
        return page.evaluate(SLIDERS)

    # where the print is in the file: layer and line of it
    first = server.wait_for(lambda: place() > [0, 1] and place(), 60, "the print to be drawn")
    server.wait_for(lambda: place() > first, 60, "what is behind it")
    assert place()[0] < LAYERS
    context.close()
    assert errors == []
    server.post("/api/job", json={"command": "cancel"})
    server.wait_state("Operational", 30)
    helpers.wait_polls(server, 1)
