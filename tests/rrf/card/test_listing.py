"""The card: what is asked, what comes of the pages, and aliases that stay what they are."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.card import listing as card
from octoprint_rrfmodel.rrf.card.listing import Aliases, CardFile, CardPlan, path_of
from octoprint_rrfmodel.rrf.wire.reply import FolderEntry, FolderPage, MalformedReply, decode_page
from octoprint_rrfmodel.rrf.wire.request import ListRequest

DATE = "2024-11-04T20:21:00"

DOS_NAME = re.compile(r"[a-z0-9][a-z0-9_]{0,7}\.(g|gco)")

NAMES = st.text(
    st.characters(exclude_categories=("Cs", "Cc"), exclude_characters='/\\:*?"<>|'), min_size=1
)


def file(name, size=10):
    return FolderEntry(name, False, size, DATE)


def folder(name):
    return FolderEntry(name, True, 0, DATE)


def page(request, *entries, next=0, error=0):
    return FolderPage(request.folder, request.first, entries, next, error)


def walk(plan, tree):
    """Answer from ``tree``, folder to entries, until nothing is asked; return the requests."""
    asked = []
    while (request := plan.next_request()) is not None:
        asked.append(request)
        assert plan.take(page(request, *tree[request.folder]))
    return asked


def paths(plan):
    return sorted(found.path for found in plan.index.files.values())


# the plan


def test_nothing_is_known_at_first():
    plan = CardPlan()
    assert plan.index is None
    assert plan.behind
    assert plan.next_request() == ListRequest("0:/gcodes")
    assert plan.next_request().line == 'M20 S3 P"0:/gcodes" R0'


def test_folders_are_entered():
    plan = CardPlan()
    tree = {
        "0:/gcodes": [file("a.gcode", 5), folder("b c"), folder("empty")],
        "0:/gcodes/b c": [folder("d"), file("Ü.g")],
        "0:/gcodes/b c/d": [file("e.nc"), file("readme.txt")],
        "0:/gcodes/empty": [],
    }
    assert {request.folder for request in walk(plan, tree)} == set(tree)
    assert paths(plan) == ["0:/gcodes/a.gcode", "0:/gcodes/b c/d/e.nc", "0:/gcodes/b c/Ü.g"]
    assert not plan.behind
    assert plan.index.file_of(plan.index.alias_of("0:/GCODES/A.gcode")) == CardFile(
        "0:/gcodes/a.gcode", 5, DATE
    )


def test_pages_are_put_together():
    plan = CardPlan()
    assert plan.take(page(plan.next_request(), file("a.g"), file("b.g"), next=2))
    assert plan.next_request() == ListRequest("0:/gcodes", 2)
    assert plan.take(page(plan.next_request(), file("c.g")))
    assert [found.name for found in plan.index.files.values()] == ["a.g", "b.g", "c.g"]


def test_page_of_another_request_is_not_taken():
    plan = CardPlan()
    plan.next_request()
    assert not plan.take(FolderPage("0:/macros", 0, (file("a.g"),), 0, 0))
    assert not plan.take(FolderPage("0:/gcodes", 5, (file("a.g"),), 0, 0))
    assert plan.take(FolderPage("0:/gcodes/", 0, (file("a.g"),), 0, 0))
    assert not plan.take(FolderPage("0:/gcodes", 0, (file("a.g"),), 0, 0))


def test_list_without_end_ends():
    plan = CardPlan()
    request = plan.next_request()
    assert plan.take(page(request, next=7))
    assert plan.next_request() is None


def test_endless_folders_end():
    plan = CardPlan()
    asked = 0
    while (request := plan.next_request()) is not None:
        plan.take(page(request, folder("a"), folder("b")))
        asked += 1
    assert asked <= card.MOST_FOLDERS
    assert paths(plan) == []


def test_so_many_files_and_no_more():
    plan = CardPlan()
    walk(plan, {"0:/gcodes": [file(f"{n}.gcode") for n in range(card.MOST_FILES + 10)]})
    assert len(plan.index.files) == card.MOST_FILES


def test_no_card_has_no_files():
    plan = CardPlan()
    plan.take(page(plan.next_request(), error=1))
    assert paths(plan) == []


@pytest.mark.parametrize("name", ["a\nb.gcode", "a\x00.gcode"])
def test_name_that_would_break_a_line_is_left_out(name):
    plan = CardPlan()
    walk(plan, {"0:/gcodes": [file(name)]})
    assert paths(plan) == []


def test_folder_that_a_comment_begins_in_is_left_out():
    plan = CardPlan()
    assert len(walk(plan, {"0:/gcodes": [folder("a;b")]})) == 1


def model(changes=1, mounted=True):
    return {"seqs": {"volChanges": [changes, 0]}, "volumes": [{"mounted": mounted}]}


@pytest.mark.parametrize("changed", [model(changes=2), model(mounted=False)])
def test_change_is_noticed(changed):
    plan = CardPlan()
    plan.observe(model())
    walk(plan, {"0:/gcodes": []})
    plan.observe(model())
    assert not plan.behind
    plan.observe(changed)
    assert plan.behind
    assert plan.notices_changes


def test_change_meanwhile_means_once_more():
    plan = CardPlan()
    plan.observe(model())
    request = plan.next_request()
    plan.observe(model(changes=2))
    plan.take(page(request))
    assert plan.next_request() == ListRequest("0:/gcodes")


@pytest.mark.parametrize(
    "odd", [{}, {"seqs": None}, {"seqs": {"volChanges": 3}}, {"volumes": [None]}, {"volumes": {}}]
)
def test_odd_model_is_harmless(odd):
    plan = CardPlan()
    plan.observe(odd)
    assert not plan.notices_changes


def test_failure_is_asked_again_and_then_given_up():
    plan = CardPlan()
    for _ in range(card.PATIENCE):
        assert plan.next_request() == ListRequest("0:/gcodes")
        plan.failed()
    assert plan.next_request() is None
    assert plan.index is None
    plan.refetch()
    assert plan.next_request() is not None


def test_list_that_fails_leaves_the_last_one():
    plan = CardPlan()
    walk(plan, {"0:/gcodes": [file("a.g")]})
    plan.refetch()
    for _ in range(card.PATIENCE):
        plan.next_request()
        plan.failed()
    assert paths(plan) == ["0:/gcodes/a.g"]


# aliases


@pytest.mark.parametrize(
    ("path", "alias"),
    [
        ("0:/gcodes/square.gcode", "square.gco"),
        ("0:/gcodes/UPPER.GCODE", "upper.gco"),
        ("0:/gcodes/auto0.g", "auto0.g"),
        ("0:/gcodes/a_b1.nc", "a_b1.gco"),
    ],
)
def test_short_name_is_its_own_alias(path, alias):
    assert list(Aliases().index([CardFile(path, 1)]).files) == [alias]


def test_alias_of_a_real_name_goes_to_that():
    files = [CardFile("0:/gcodes/cube.gcode", 1), CardFile("0:/gcodes/cube.gco", 2)]
    index = Aliases().index(files)
    assert index.file_of("cube.gco").size == 2
    assert len(index.files) == 2


@given(st.lists(NAMES, min_size=1, max_size=30), st.randoms())
def test_aliases_are_dos_names_and_stay(names, random):
    files = [CardFile(f"0:/gcodes/{name}.gcode", len(name)) for name in names]
    aliases = Aliases()
    index = aliases.index(files)
    assert all(DOS_NAME.fullmatch(alias) for alias in index.files)
    assert len(index.files) == len({found.path.lower() for found in files})
    before = dict(index.files)
    random.shuffle(files)
    assert {a: f.path.lower() for a, f in aliases.index(files).files.items()} == {
        a: f.path.lower() for a, f in before.items()
    }
    for alias, found in index.files.items():
        assert index.alias_of(found.path) == alias
        assert index.file_of("/" + alias.upper()) is found


def test_alias_does_not_depend_on_other_files():
    clip = CardFile("0:/gcodes/Spare parts/clip (L).gcode", 1)
    others = [CardFile(f"0:/gcodes/Spare parts/clip ({n}).gcode", 1) for n in range(50)]
    alone = Aliases().index([clip]).alias_of(clip.path)
    assert Aliases().index([*others, clip]).alias_of(clip.path) == alone


def test_unknown_alias_is_no_file():
    index = Aliases().index([])
    assert index.file_of("a.gco") is None
    assert index.alias_of("0:/gcodes/a.gco") is None


# values


@pytest.mark.parametrize(
    ("name", "path"),
    [
        ("a b.gcode", "0:/gcodes/a b.gcode"),
        ("sub/a.gcode", "0:/gcodes/sub/a.gcode"),
        ("/gcodes/a.gcode", "0:/gcodes/a.gcode"),
        ("0:/macros/x", "0:/macros/x"),
        ("sub\\a.g", "0:/gcodes/sub/a.g"),
    ],
)
def test_path_of_a_name(name, path):
    assert path_of(name) == path


@pytest.mark.parametrize("date", ["", "1980-01-01T00:00:00", "yesterday", "9999-99-99T00:00:00"])
def test_date_of_a_board_without_clock_is_none(date):
    assert CardFile("0:/gcodes/a.g", 1, date).modified is None


def test_date_is_local_time():
    noon = CardFile("0:/gcodes/a.g", 1, "2024-06-01T12:00:00").modified
    assert CardFile("0:/gcodes/a.g", 1, "2024-06-01T12:01:00").modified == noon + 60


def test_page_is_decoded():
    text = (
        '{"dir":"0:/gcodes/","first":3,"files":[{"type":"f","name":"a.gcode","size":12,'
        '"date":"2024-11-04T20:21:00"},{"type":"d","name":"sub"},{"size":1}],"next":9}'
    )
    assert decode_page(text) == FolderPage(
        "0:/gcodes/", 3, (file("a.gcode", 12), FolderEntry("sub", True, 0, "")), 9, 0
    )


def test_error_is_decoded():
    assert decode_page('{"dir":"0:/x","first":0,"files":[],"next":0,"err":2}').error == 2


@pytest.mark.parametrize(
    "text",
    [
        '{"dir":"0:/gcodes"',
        '{"dir":1,"files":[]}',
        '{"dir":"a","files":{}}',
        '{"dir":"a","next":"1"}',
        '{"dir":"0:/gcodes","first":0,"files":["a.gcode","*sub"],"next":0,"err":0}',
    ],
)
def test_spoilt_page_is_malformed(text):
    with pytest.raises(MalformedReply):
        decode_page(text)
