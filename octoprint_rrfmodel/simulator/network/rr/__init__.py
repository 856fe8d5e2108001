"""``rr_*``: what a board on its own is asked, as RepRapFirmware answers it."""
