"""The connection panel for a board on the network, and its page, in a browser."""

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN
from tests.support.browser import new_context, new_page, open_octoprint

from .. import helpers
from . import bench

SECRET = "open-sesame"


@pytest.fixture
def face(face_factory):
    made = face_factory(machine="cartesian", speed=10)
    made.board.execute(f'M551 P"{SECRET}"', channel="aux")
    return made


def test_board_with_a_password_is_connected_in_the_panel(browser, server_factory, face):
    server = server_factory()
    host = face.url.partition("//")[2]
    context, errors = new_context(browser), []
    page = new_page(context, errors)
    open_octoprint(page, server, ADMIN)
    page.locator("#connection_option").select_option("rrfmodel")
    address = page.locator("[data-test=network-host]")
    expect(page.locator("#printer_connect")).to_be_disabled()
    address.fill(host)
    page.locator("[data-test=network-password]").fill(SECRET)
    page.locator("[data-test=network-keep]").click()
    expect(page.locator("#connection_options_rrfmodel [role=status]")).to_have_text("Kept.")
    expect(page.locator("[data-test=network-password]")).to_have_value("")
    page.locator("#printer_connect").click()
    helpers.wait_ready(server, 30)
    server.wait_state("Operational", 20)
    expect(page.locator("#sidebar_plugin_rrfmodel")).to_contain_text("X ")
    expect(page.locator("#rrfmodel_network_hosts option")).to_have_attribute("value", host)
    assert SECRET not in page.content()
    bench.command(server, "network_password", host=host, password="")
    helpers.disconnect(server)
    context.close()
    assert errors == []
