"""The dashboard for Grafana: its form, and that it asks for nothing that there isn't."""

import itertools
import json
import re

import pytest

from octoprint_rrfmodel.rrf.metrics import METRICS
from tests.support.places import ROOT

FILE = ROOT / "extras" / "grafana" / "rrfmodel.json"
COLUMNS = 24
LABELS = {metric.name: set(metric.labels) for metric in METRICS}

METRIC = re.compile(r"\brrf_\w+")
LEGEND = re.compile(r"{{(\w+)}}")
MATCHER = re.compile(r"(\w+)(?:=~|!=|!~|=)\"")
GROUPED = re.compile(r"\b(?:on|by|group_left)\s*\(([^)]*)\)")

# what Prometheus adds to each sample
TARGET_LABELS = {"instance", "job"}


@pytest.fixture(scope="module")
def dashboard():
    return json.loads(FILE.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def panels(dashboard):
    return dashboard["panels"]


def queries(dashboard):
    """Return every query with the format of its legend."""
    found = [
        (target["expr"], target["legendFormat"])
        for panel in dashboard["panels"]
        for target in panel.get("targets", ())
    ]
    found += [(note["expr"], note["titleFormat"]) for note in dashboard["annotations"]["list"]]
    return found


def test_every_query_names_metrics_that_there_are(dashboard):
    asked = set()
    for expression, _ in queries(dashboard):
        names = METRIC.findall(expression)
        assert names, expression
        asked.update(names)
    assert asked - LABELS.keys() == set()
    assert {name.split("_")[1] for name in asked} >= {
        "heater",
        "fan",
        "job",
        "speed",
        "extruder",
        "board",
        "warnings",
        "polls",
    }


def test_every_query_names_labels_that_there_are(dashboard):
    for expression, legend in queries(dashboard):
        known = TARGET_LABELS.union(*(LABELS[name] for name in METRIC.findall(expression)))
        named = {*LEGEND.findall(legend), *MATCHER.findall(expression)}
        for group in GROUPED.findall(expression):
            named.update(re.findall(r"\w+", group))
        assert named <= known, expression


def test_every_metric_of_a_query_is_of_the_printers_that_were_chosen(dashboard):
    for expression, _ in queries(dashboard):
        chosen = re.findall(r'\brrf_\w+{instance=~"\$instance"', expression)
        assert len(chosen) == len(METRIC.findall(expression)), expression


def test_dashboard_can_be_imported_anywhere(dashboard, panels):
    assert isinstance(dashboard["schemaVersion"], int)
    assert dashboard["title"] and dashboard["uid"]
    assert "id" not in dashboard, "it would replace another one"
    source, printer = dashboard["templating"]["list"]
    assert (source["name"], source["type"], source["query"]) == (
        "datasource",
        "datasource",
        "prometheus",
    )
    assert (printer["name"], printer["type"]) == ("instance", "query")
    assert (printer["multi"], printer["includeAll"]) == (True, True)
    assert printer["query"]["query"] == "label_values(rrf_info, instance)"
    used = {"type": "prometheus", "uid": "${datasource}"}
    asking = [printer, *dashboard["annotations"]["list"]]
    for panel in panels:
        if panel["type"] != "row":
            asking += [panel, *panel["targets"]]
    assert all(place["datasource"] == used for place in asking)


def test_panels_have_a_number_and_a_title_of_their_own(panels):
    assert len({panel["id"] for panel in panels}) == len(panels)
    assert len({panel["title"] for panel in panels}) == len(panels)
    for panel in panels:
        assert panel["type"] in {"row", "stat", "gauge", "timeseries"}
        if panel["type"] != "row":
            letters = [target["refId"] for target in panel["targets"]]
            assert letters and len(set(letters)) == len(letters)
            assert panel["fieldConfig"]["defaults"]["unit"]


def test_panels_lie_side_by_side(panels):
    cells = {}
    for panel in panels:
        place = panel["gridPos"]
        assert place["w"] > 0 < place["h"] and place["x"] >= 0 <= place["y"]
        assert place["x"] + place["w"] <= COLUMNS
        across = range(place["x"], place["x"] + place["w"])
        down = range(place["y"], place["y"] + place["h"])
        for cell in itertools.product(across, down):
            assert cells.setdefault(cell, panel["title"]) == panel["title"]
    bottom = max(y for _, y in cells) + 1
    assert len(cells) == COLUMNS * bottom, "there are holes"
