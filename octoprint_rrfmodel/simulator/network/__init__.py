"""The network face of a board: standalone by ``rr_*``, and behind a single-board computer."""
