"""How bytes travel: the seam that the rest asks, the poller, the worker."""
