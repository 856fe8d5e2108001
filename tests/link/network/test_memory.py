"""What is kept of boards on the network."""

from octoprint_rrfmodel.link.network.address import address_of
from octoprint_rrfmodel.link.network.memory import Memory


class Settings:
    def __init__(self):
        self.kept = {}
        self.saves = 0

    def get(self, path, merged=False):
        return self.kept.get(tuple(path))

    def get_float(self, path, min=None):
        return self.kept.get(tuple(path))

    def set(self, path, value, force=False):
        self.kept[tuple(path)] = value

    def save(self):
        self.saves += 1


def test_passwords_are_kept_by_address_and_forgotten():
    settings = Settings()
    memory = Memory(lambda: settings)
    duet, other = address_of("http://duet/"), address_of("other:8080")
    memory.keep_password(duet, "secret")
    memory.keep_password(other, "other")
    assert memory.password(address_of("DUET")) == "secret"
    memory.keep_password(duet, "")
    assert memory.password(duet) == ""
    assert memory.password(other) == "other"
    assert settings.saves == 3


def test_hosts_are_remembered_once():
    settings = Settings()
    memory = Memory(lambda: settings)
    for _ in range(3):
        memory.keep_host(address_of("duet.local"))
    assert (memory.hosts(), settings.saves) == (["duet.local"], 1)


def test_patience_is_half_an_hour_unless_somebody_says_otherwise():
    settings = Settings()
    memory = Memory(lambda: settings)
    assert memory.patience() == 1800
    settings.kept["network", "gap_minutes"] = 2.0
    assert memory.patience() == 120
