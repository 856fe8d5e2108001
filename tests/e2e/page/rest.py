"""A page that stays open, brought back to what it was when it was opened."""

from tests.support import waiting
from tests.support.browser import SIZE

FORGET = """() => {
    const views = OctoPrint.coreui.viewmodels;
    const core = views.rrfModelViewModel;
    // as if the machine had gone: its rows, message box, folders and notifications go with it
    core.fromStatus({at: -Infinity});
    core.onUserPermissionsChanged();
    $(".modal.in").modal("hide");
    PNotify.removeAll();
    document.querySelectorAll("style.of-a-test").forEach((style) => style.remove());
    if (document.activeElement) document.activeElement.blur();

    core.isWide(false);
    views.rrfModelMachineViewModel.jogSpeed(6000);
    views.rrfModelMachineViewModel.extrudeSpeed(5);
    views.rrfModelMachineViewModel.macroFilter("");
    views.rrfModelMachineViewModel.showsAllExtruders(false);
    Object.values(views.rrfModelMachinePartsViewModel.folds).forEach((fold) => fold.isOpen(false));
    views.rrfModelJobViewModel.layers.all(true);
    views.rrfModelJobViewModel.card.forget();
    views.rrfModelJobViewModel.past.all(false);
    const chart = views.rrfModelChartViewModel;
    chart.span(15 * 60);
    if (chart.isHeld()) chart.hold();
    const tree = views.rrfModelModelViewModel;
    tree.text("");
    tree.onlyChanged(false);
    tree.onlyLive(false);
    tree.openAll(false)();
    window.location.hash = "#tab_plugin_rrfmodel/machine";
    window.scrollTo(0, 0);
}"""

LEFT = """() => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const seen = ".modal.in, .modal-backdrop, .ui-pnotify";
    return {
        seen: Array.from(document.querySelectorAll(seen)).map((each) => each.textContent.trim()),
        // the last key to come, with the whole model alone
        isModelThere: "volumes" in core.latest,
        isReady: !!core.status().ready,
        isShown: core.isShown("machine")()
    };
}"""

AT_REST = {"seen": [], "isModelThere": True, "isReady": True, "isShown": True}


def bring_to_rest(page):
    """Return once the page shows the machine, and nothing of what was done in it before."""
    page.unroute_all(behavior="ignoreErrors")
    if page.viewport_size != SIZE:
        page.set_viewport_size(SIZE)
    page.mouse.move(0, 0)
    page.evaluate(FORGET)
    left = {}

    def is_at_rest():
        left.update(page.evaluate(LEFT))
        return left == AT_REST

    try:
        waiting.wait_for(is_at_rest, 45, "the page to be at rest")
    except AssertionError as error:
        raise AssertionError(f"{error}; {left}") from None
