"""OctoPrint as the parts are handed it, where a test has none running."""

from octoprint_rrfmodel.host.host import Host


def host_of(folder, nothing, settings, **members):
    """Return a host of ``settings`` and a folder; ``nothing`` stands for all but ``members``."""
    return Host(
        **{
            **dict.fromkeys(("printer", "profiles", "plugins", "users", "files"), lambda: nothing),
            "settings": lambda: settings,
            "folder": lambda: str(folder),
            "version": lambda: "0",
            "fire": lambda event, payload: None,
            "tell_pages": lambda message: None,
            "path_on_disk": lambda path: str(folder / path),
            **members,
        }
    )
