"""Run every measurement and print each beside what it is compared with."""

from tests.bench import hooks, live_reply, page, server


def main():
    """Print all measurements."""
    live_reply.measure()
    hooks.measure()
    server.measure()
    page.measure()


if __name__ == "__main__":
    main()
