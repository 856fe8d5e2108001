"""The tab over the whole window: on a large screen, on a telephone, remembered, by its address."""

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN
from tests.support.browser import wait_usable

from . import both_hosts, open_view, own_errors, part, show_view
from .test_everyone import serious, show_filled

BOARD = {"machine": "toolchanger"}

IS_WIDE = "document.body.classList.contains('rrfmodel-wide')"

SIDEWAYS = """() => {
    const {scrollWidth, clientWidth} = document.documentElement;
    return scrollWidth - clientWidth;
}"""

SMALL = """() => Array.from(document.querySelectorAll(
        "#tab_plugin_rrfmodel :is(.btn, button, select, summary, [type=number], [type=text])"
    )).filter(function (each) {
        const {width, height} = each.getBoundingClientRect();
        return width && (height < 40 || width < 40) && !each.closest(".rrfmodel-tree");
    }).map((each) => each.outerHTML.slice(0, 120))"""


def switch(page):
    return page.locator("[data-test=wide]")


def views(page):
    found = page.locator("#rrfmodel_views [data-test^=view-]").all()
    return [each.get_attribute("data-test").removeprefix("view-") for each in found]


@both_hosts
def test_the_whole_window_is_used_and_other_tabs_stay_as_they_are(page, page_errors):
    sidebar = page.locator("#sidebar")
    expect(sidebar).to_be_visible()
    narrow = page.locator("#tab_plugin_rrfmodel").bounding_box()["width"]
    expect(switch(page)).to_have_attribute("aria-pressed", "false")
    switch(page).click()
    expect(switch(page)).to_have_attribute("aria-pressed", "true")
    expect(sidebar).to_be_hidden()
    assert page.evaluate(IS_WIDE)
    assert page.locator("#tab_plugin_rrfmodel").bounding_box()["width"] > 1.8 * narrow
    page.locator("#temp_link a").click()
    expect(sidebar).to_be_visible()
    assert not page.evaluate(IS_WIDE)
    show_view(page, "job")
    expect(sidebar).to_be_hidden()
    switch(page).click()
    expect(sidebar).to_be_visible()
    assert own_errors(page_errors) == []


@pytest.mark.parametrize("size", [(1920, 1080), (1400, 900), (768, 1024), (480, 800)])
def test_nothing_scrolls_sideways(page, size):
    width, height = size
    switch(page).click()
    page.set_viewport_size({"width": width, "height": height})
    for view in views(page):
        show_view(page, view)
        assert page.evaluate(SIDEWAYS) <= 0, view


def test_columns_on_a_large_screen_and_one_on_a_telephone(page):
    switch(page).click()
    lefts = """() => new Set(Array.from(document.querySelectorAll("[data-test=parts] section, "
        + "#rrfmodel_machine fieldset, #rrfmodel_machine section"))
        .filter((each) => each.offsetWidth)
        .map((each) => Math.round(each.getBoundingClientRect().left))).size"""
    page.set_viewport_size({"width": 1920, "height": 1080})
    assert page.evaluate(lefts) > 1
    page.set_viewport_size({"width": 480, "height": 800})
    assert page.evaluate(
        """() => Array.from(document.querySelectorAll("[id^=rrfmodel_machine]"))
            .filter((each) => each.offsetHeight)
            .every((each) => each.getBoundingClientRect().left < 40)"""
    )


def test_a_finger_hits_what_it_is_meant_for(page):
    switch(page).click()
    page.set_viewport_size({"width": 480, "height": 800})
    viewport = page.locator("meta[name=viewport]")
    expect(viewport).to_have_attribute("content", "width=device-width, initial-scale=1")
    for view in views(page):
        show_view(page, view)
        small = page.evaluate(SMALL)
        assert not small, (view, "\n".join(small))
    switch(page).click()
    expect(viewport).to_have_attribute("content", "width=980")


@pytest.mark.parametrize("size", [(1920, 1080), (480, 800)])
def test_axe_finds_nothing_serious(page, size, page_errors):
    switch(page).click()
    width, height = size
    page.set_viewport_size({"width": width, "height": height})
    for view in views(page):
        show_filled(page, view)
        assert serious(page) == [], view
    assert own_errors(page_errors) == []


def test_its_address_and_what_is_remembered(own_page, server, page_errors):
    open_view(own_page, server, ADMIN, "job")
    assert not own_page.evaluate(IS_WIDE)
    own_page.evaluate("window.location.hash = '#tab_plugin_rrfmodel/machine?wide'")
    part(own_page.locator("#rrfmodel_machine"), "machine").wait_for()
    own_page.wait_for_function(IS_WIDE)
    for _again in range(2):
        own_page.reload()
        wait_usable(own_page)
        part(own_page.locator("#rrfmodel_machine"), "machine").wait_for()
        own_page.wait_for_function(IS_WIDE)
        # the second time without the word in its address
        own_page.evaluate("window.location.hash = '#tab_plugin_rrfmodel/machine'")
    switch(own_page).click()
    own_page.reload()
    wait_usable(own_page)
    part(own_page.locator("#rrfmodel_machine"), "machine").wait_for()
    assert not own_page.evaluate(IS_WIDE)
    assert own_errors(page_errors) == []
