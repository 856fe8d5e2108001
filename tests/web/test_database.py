"""What clients keep: keys, limits, and what is on the disk."""

import json

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.web.moonraker.database import Database, file_name
from octoprint_rrfmodel.web.moonraker.database_methods import database_methods
from octoprint_rrfmodel.web.moonraker.methods import Call, Methods
from tests.support.refusals import refused


@pytest.fixture
def database(tmp_path):
    return Database(lambda: str(tmp_path))


@pytest.fixture
def call(database):
    methods = Methods(database_methods(database))
    return lambda name, **params: methods.named(f"server.database.{name}").run(Call(params, None))


def test_a_client_finds_what_it_has_kept(call):
    kept = call("post_item", namespace="mainsail", key="a.b", value={"c": [1, None]})
    assert kept == {"namespace": "mainsail", "key": "a.b", "value": {"c": [1, None]}}
    assert call("get_item", namespace="mainsail", key="a.b.c")["value"] == [1, None]
    assert call("get_item", namespace="mainsail", key=["a", "b"])["value"] == {"c": [1, None]}
    assert call("get_item", namespace="mainsail")["value"] == {"a": {"b": {"c": [1, None]}}}
    assert call("list") == {"namespaces": ["mainsail"], "backups": []}
    assert call("delete_item", namespace="mainsail", key="a.b")["value"] == {"c": [1, None]}
    assert call("get_item", namespace="mainsail", key="a")["value"] == {}
    assert call("delete_item", namespace="mainsail", key="a")["value"] == {}
    assert call("list")["namespaces"] == []


def test_a_list_of_names_may_have_dots_in_them(call):
    call("post_item", namespace="files", key=["a.gcode", "seen"], value=True)
    assert call("get_item", namespace="files")["value"] == {"a.gcode": {"seen": True}}


def test_it_is_there_after_a_restart(database, tmp_path):
    database.put("Mainsail", "a", 1)
    database.put("mainsail", "a", 2)
    database.put("../é", "a", 3)
    again = Database(lambda: str(tmp_path))
    assert again.names() == ["../é", "Mainsail", "mainsail"]
    assert [again.get(name, "a") for name in again.names()] == [3, 1, 2]
    files = {path.name for path in (tmp_path / "database").iterdir()}
    assert files == {"mainsail.json", "%4dainsail.json", "%2e%2e%2f%c3%a9.json"}
    again.delete("mainsail", "a")
    assert not (tmp_path / "database" / "mainsail.json").exists()


def test_no_two_namespaces_share_a_file():
    names = ["a", "A", "%41", "a.json", ".", "..", "a/b", "a%2fb", "é", "e"]
    found = [file_name(name).lower() for name in names]
    assert len(set(found)) == len(names)
    assert not [name for name in found if "/" in name or name.startswith(".")]


@pytest.mark.parametrize(
    "key", ["", ".", "a.", "a..b", [], [""], [1], 5, None, {}, ["a"] * 21, "a" * 201], ids=repr
)
def test_no_key(database, key):
    database.put("a", "a", 1)
    refused(400, database.put, "a", key, 1)
    refused(400, database.delete, "a", key)
    if key is not None:
        refused(400, database.get, "a", key)
    assert database.get("a") == {"a": 1}


@pytest.mark.parametrize("namespace", ["", "a" * 65, "a\n", "\ud800", "é" * 40], ids=repr)
def test_no_namespace(database, namespace):
    refused(400, database.put, namespace, "a", 1)
    assert database.names() == []


def test_what_is_not_there(database):
    refused(404, database.get, "a")
    database.put("a", "b", 1)
    for key in ("c", "b.c"):
        refused(404, database.get, "a", key)
        refused(404, database.delete, "a", key)
    refused(400, database.put, "a", "b.c", 1)
    assert database.get("a") == {"b": 1}


def nested(levels):
    value = 1
    for _ in range(levels):
        value = [value]
    return value


@pytest.mark.parametrize(
    "value",
    [float("nan"), float("inf"), nested(101), nested(900), "a" * 256 * 1024],
    ids=["nan", "inf", "101 levels", "900 levels", "too large"],
)
def test_no_value(database, value):
    database.put("a", "b", 1)
    refused(400, database.put, "a", "b", value)
    assert database.get("a") == {"b": 1}
    database.put("a", "b", nested(100))


def test_it_is_bounded(database, monkeypatch):
    monkeypatch.setattr("octoprint_rrfmodel.web.moonraker.database.LARGEST", 1000)
    for number in range(9):
        database.put("a", f"k{number}", "a" * 95)
    refused(400, database.put, "b", "k", "a" * 100)
    assert database.names() == ["a"]
    database.delete("a", "k0")
    database.put("b", "k", "a" * 100)
    refused(400, database.put, "b", "k", "a" * 300)
    assert database.get("b", "k") == "a" * 100


def test_no_more_than_fifty_namespaces(database):
    for number in range(50):
        database.put(f"n{number}", "a", 1)
    refused(400, database.put, "one more", "a", 1)
    assert len(database.names()) == 50 and "one more" not in database.names()
    database.put("n7", "a", 2)
    assert database.get("n7", "a") == 2


def test_nothing_is_lost_where_the_disk_says_no(database, tmp_path):
    database.put("a", "b", 1)
    file = tmp_path / "database" / "a.new"
    file.mkdir()
    refused(500, database.put, "a", "b", 2)
    assert database.get("a", "b") == 1
    file.rmdir()
    database.put("a", "b", 2)
    assert json.loads((tmp_path / "database" / "a.json").read_text()) == {"b": 2}


@pytest.mark.parametrize("text", ["", "{", "[]", "5"])
def test_a_file_that_can_not_be_read_is_left_out(tmp_path, text):
    (tmp_path / "database").mkdir()
    (tmp_path / "database" / "a.json").write_text(text)
    assert Database(lambda: str(tmp_path)).names() == []


@pytest.mark.parametrize("method", ["post_item", "get_item", "delete_item"])
def test_what_is_missing_is_named(call, method):
    assert refused(400, call, method, key="a", value=1).startswith("namespace ")
    assert refused(400, call, method, namespace=3, key="a", value=1).startswith("namespace ")
    status, missing = (400, "value") if method == "post_item" else (404, "namespace")
    assert missing in refused(status, call, method, namespace="a", key="a")
