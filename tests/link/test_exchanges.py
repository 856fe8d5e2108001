"""What polls have asked and got is kept for a while, and reaches the poller all the same."""

from octoprint_rrfmodel.link.exchanges import MOST_LENGTH, Exchanges


class Poller:
    """Notes what it is told."""

    def __init__(self):
        self.told = []
        self.line = 'M409 K"" F"d99fin"'

    def asked(self):
        return self.line

    def poll_sent(self, at, number=None):
        self.told.append(("poll_sent", at, number))

    def reply(self, text, number=None):
        self.told.append(("reply", text, number))

    def refused(self, line):
        self.told.append(("refused", line))


def test_what_goes_by_is_kept_and_handed_on():
    poller = Poller()
    exchanges = Exchanges(poller, lambda: 10.0)
    exchanges.poll_sent(9.0, 5)
    exchanges.reply("{}", 5)
    exchanges.refused("Error: Bad command")
    assert exchanges.latest() == [
        (1.0, "sent", poller.line),
        (0.0, "received", "{}"),
        (0.0, "refused", "Error: Bad command"),
    ]
    assert poller.told == [
        ("poll_sent", 9.0, 5),
        ("reply", "{}", 5),
        ("refused", "Error: Bad command"),
    ]


def test_a_late_note_of_a_poll_that_is_over():
    poller = Poller()
    poller.line = None
    exchanges = Exchanges(poller, lambda: 10.0)
    exchanges.poll_sent(9.0)
    assert exchanges.latest() == [] and poller.told == [("poll_sent", 9.0, None)]


def test_the_oldest_goes_and_nothing_is_too_long():
    exchanges = Exchanges(Poller(), lambda: 0.0)
    for number in range(50):
        exchanges.reply(f"{number:05}" * 2000)
    texts = [text for _, _, text in exchanges.latest()]
    assert texts[-1] == "00049" * 2000 and sum(map(len, texts)) <= MOST_LENGTH
    exchanges.reply("x" * (3 * MOST_LENGTH))
    assert [len(text) for _, _, text in exchanges.latest()] == [MOST_LENGTH]
