"""The scripts and styles of the page, in the order in which they run."""

SCRIPTS = (
    # what the others are made of
    "words",
    "terms",
    "markup",
    "rows",
    "now",
    "wide",
    "pending",
    "number",
    "commands",
    "alerts",
    "forbidden",
    "effects",
    "streamed",
    "job_file",
    "job_times",
    "job_layers",
    "job_controls",
    "bed_map",
    "job_objects",
    "job_card",
    "job_past",
    "core",
    "history",
    "tree",
    "chart_parts",
    "machine_curve",
    "machine_heat",
    "machine_move",
    "machine_turn",
    "machine_spindle",
    "machine_card",
    "machine_facts",
    "machine_offsets",
    "machine_bed",
    "machine_folds",
    "panels_tuning",
    "panels_more",
    # regions of the page, each on its own
    "notifications",
    "strip",
    "sidebar",
    "navbar",
    "machine",
    "machine_parts",
    "job",
    "chart",
    "console",
    "model",
    "box",
    "settings",
    "network",
)

ASSETS = {
    "js": [f"js/{name}.js" for name in SCRIPTS],
    "clientjs": ["clientjs/rrfmodel.js"],
    "css": [f"css/{name}.css" for name in ("rrfmodel", "answers", "machine", "jobview", "words")],
}
"""In the form of OctoPrint's ``AssetPlugin``."""

ON_DEMAND = ("on_demand/files.js", "on_demand/files.css")
"""What no page brings: scripts of those fetch it when somebody first wants what it shows."""


def assets_of(has_network):
    """Return those that a page needs; without connections over the network less."""
    if has_network:
        return ASSETS
    return {**ASSETS, "js": [name for name in ASSETS["js"] if name != "js/network.js"]}
