"""Who may use the board over the network: its password, and the site of foreign pages."""

from __future__ import annotations

from ..model.tree import ObjectModel

NO_PASSWORD = ("", "reprap")


class NetworkAccess:
    """Kept through restarts, as ``config.g`` sets it each time."""

    def __init__(self, model: ObjectModel):
        self._model = model
        self.password = ""
        self.cors_site = ""
        """What ``Access-Control-Allow-Origin`` says, nothing where it isn't sent."""

    @property
    def has_password(self) -> bool:
        """Whether a password is set; the default one is none."""
        return self.password not in NO_PASSWORD

    def is_right(self, password: str) -> bool:
        return not self.has_password or password == self.password

    def allow_site(self, site: str) -> None:
        """Let pages of that site ask the board."""
        self.cors_site = site
        network = self._model.data.get("network")
        if network is not None and "corsSite" in network:
            network["corsSite"] = site or None
            self._model.bump("network")
