"""What was changed of OctoPrint's own is known as long as OctoPrint is there."""

import shutil

import pytest

from octoprint_rrfmodel.host.journal import Journal


@pytest.fixture
def folders(tmp_path):
    own = tmp_path / "data" / "rrfmodel"
    own.mkdir(parents=True)
    return tmp_path, own


@pytest.fixture
def journal(folders):
    base, own = folders
    return Journal(lambda: str(base), lambda: str(own), "changed_settings.json")


def test_nothing_is_written_down_at_first(journal):
    assert journal.read() == {}
    journal.forget()


def test_row_32_outlives_the_plugins_data_folder(folders, journal):
    journal.write({"uppercase": {"added": ["M409"]}})
    shutil.rmtree(folders[1])
    folders[1].mkdir()
    assert journal.read() == {"uppercase": {"added": ["M409"]}}
    journal.forget()
    assert journal.read() == {}
    assert list(folders[0].rglob("*.json")) == []


def test_file_of_an_older_version_is_read_and_moves_with_the_next_change(folders, journal):
    older = folders[1] / "changed_settings.json"
    older.write_text('{"a": 1}', encoding="utf-8")
    assert journal.read() == {"a": 1}
    journal.write({"a": 1, "b": 2})
    assert not older.exists()
    assert journal.read() == {"a": 1, "b": 2}


def test_file_of_an_older_version_is_forgotten_too(folders, journal):
    older = folders[1] / "changed_settings.json"
    older.write_text('{"a": 1}', encoding="utf-8")
    journal.forget()
    assert not older.exists() and journal.read() == {}
