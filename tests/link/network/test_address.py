"""What may be written where a board's address is asked for."""

import pytest

from octoprint_rrfmodel.link.network.address import Address, address_of

GOOD = (
    ("duet.local", ("http", "duet.local", 80), "duet.local"),
    (" 192.168.1.14 ", ("http", "192.168.1.14", 80), "192.168.1.14"),
    ("HTTP".lower() + "://duet/", ("http", "duet", 80), "duet"),
    ("duet:8080", ("http", "duet", 8080), "duet:8080"),
    ("https://duet.example.org", ("https", "duet.example.org", 443), "https://duet.example.org"),
    ("https://duet:8443", ("https", "duet", 8443), "https://duet:8443"),
    ("fe80::1", ("http", "fe80::1", 80), "[fe80::1]"),
    ("[2001:db8::1]:81", ("http", "2001:db8::1", 81), "[2001:db8::1]:81"),
    ("RRF-SIM", ("http", "rrf-sim", 80), "rrf-sim"),
    ("küche", ("http", "küche", 80), "küche"),
)

BAD = (
    *("", " ", "duet/rr_connect", "http://duet/machine", "duet?x=1", "duet#x", "user@duet"),
    *("http://user:secret@duet", "ftp://duet", "file:///etc/passwd", "duet:0", "duet:65536"),
    *("duet:port", "du et", "duet\r\nHost: other", "-duet", "duet..local", "[1.2.3.4]", "[::1"),
    *("a" * 300, "duet\\x", "fe80::1%eth0", "http://", "//duet", None, 5, "duet\x00"),
)


@pytest.mark.parametrize(("text", "parts", "short"), GOOD)
def test_address(text, parts, short):
    found = address_of(text)
    assert found == Address(*parts)
    assert found.text == short
    assert address_of(short) == found


@pytest.mark.parametrize("text", BAD)
def test_nothing_else_is_one(text):
    assert address_of(text) is None
