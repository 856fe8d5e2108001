"""The table of Moonraker's methods: their addresses, what a call is given, who may call."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.web.moonraker.methods import Call, Method, Methods, run


def caller(*permissions):
    return SimpleNamespace(may=lambda permission: permission in permissions)


@pytest.mark.parametrize(
    "name, verbs, address",
    [
        ("server.info", (), ("GET", "server/info")),
        ("printer.objects.query", ("GET", "POST"), ("GET POST", "printer/objects/query")),
        ("server.database.get_item", (), ("GET", "server/database/item")),
        ("server.database.post_item", (), ("POST", "server/database/item")),
        ("server.database.delete_item", (), ("DELETE", "server/database/item")),
        ("server.files.get_directory", (), ("GET", "server/files/directory")),
        ("machine.device_power.devices", (), ("GET", "machine/device_power/devices")),
        ("server.files.delete_file", ("DELETE",), ("DELETE", "server/files/delete_file")),
    ],
)
def test_the_address_is_in_the_name(name, verbs, address):
    row = Method(name, lambda call: None, verbs=verbs)
    assert row.address == address
    table = Methods([row])
    assert table.named(name) is row
    wanted, path = address
    assert [table.at(verb, path) for verb in wanted.split()] == [row] * len(wanted.split())
    assert table.at("PUT", path) is None
    assert table.verbs_of(path) == sorted(wanted.split())
    assert table.verbs_of("server") == []


@pytest.mark.parametrize(
    "read, value, wanted",
    [
        ("text", "a", "a"),
        ("number", "1.5", 1.5),
        ("number", 2, 2),
        ("whole", "12", 12),
        ("whole", 3.0, 3),
        ("flag", "True", True),
        ("flag", "no", False),
        ("flag", True, True),
        ("flag", 1, False),
    ],
)
def test_values_also_as_text(read, value, wanted):
    assert getattr(Call({"it": value}, None), read)("it") == wanted


@pytest.mark.parametrize(
    "read, value",
    [
        ("text", None),
        ("text", 3),
        ("number", "x"),
        ("number", "nan"),
        ("number", float("inf")),
        ("number", True),
        ("number", [1]),
        ("number", None),
        ("whole", "-1"),
        ("whole", 1.5),
        ("whole", "1e400"),
    ],
)
def test_what_is_of_the_wrong_kind_is_refused_in_a_sentence(read, value):
    params = {} if value is None else {"it": value}
    with pytest.raises(RequestRefused, match=r"^it .*\.$") as refused:
        getattr(Call(params, None), read)("it")
    assert refused.value.status == 400


def test_what_is_missing_may_be_something_else():
    assert Call({}, None).text("it", "other") == "other"
    assert Call({}, None).whole("it", 7) == 7
    assert Call({}, None).flag("it") is False


def test_who_lacks_the_permission_is_refused_before_anything_is_done():
    done = []
    row = Method("printer.restart", done.append, "PLUGIN_RRFMODEL_CONTROL")
    with pytest.raises(RequestRefused, match="administrator") as refused:
        run(row, Call({}, caller("PLUGIN_RRFMODEL_READ")))
    assert refused.value.status == 403 and done == []
    run(row, Call({}, caller("PLUGIN_RRFMODEL_CONTROL")))
    assert len(done) == 1
