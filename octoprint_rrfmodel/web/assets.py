"""The scripts and styles of the page, in the order in which they run."""

SCRIPTS = (
    # what the others are made of
    "words",
    "rows",
    "core",
    "history",
    "tree",
    "chart_parts",
    "machine_heat",
    "machine_facts",
    # regions of the page, each on its own
    "notifications",
    "sidebar",
    "machine",
    "machine_parts",
    "job",
    "chart",
    "model",
    "box",
    "settings",
)

ASSETS = {
    "js": [f"js/{name}.js" for name in SCRIPTS],
    "clientjs": ["clientjs/rrfmodel.js"],
    "css": ["css/rrfmodel.css"],
}
"""In the form of OctoPrint's ``AssetPlugin``."""
