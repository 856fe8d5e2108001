"""What a page loads of the plugin: all of it is there, and it isn't much."""

from octoprint_rrfmodel.web.assets import ASSETS
from tests.support.places import ROOT

STATIC = ROOT / "octoprint_rrfmodel" / "static"

MOST_BYTES = 150_000


def test_every_file_is_loaded_and_none_is_missing():
    named = {name for names in ASSETS.values() for name in names}
    there = {str(path.relative_to(STATIC)) for path in STATIC.rglob("*") if path.is_file()}
    assert named == there


def test_the_page_stays_small():
    sizes = {str(path): path.stat().st_size for path in STATIC.rglob("*") if path.is_file()}
    assert sum(sizes.values()) < MOST_BYTES, sizes
