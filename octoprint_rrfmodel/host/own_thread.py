"""Code of others, and what may wait for it, on a thread of its own."""

import threading


def on_a_thread_of_its_own(function, *arguments, name):
    """Start ``function`` and return its thread, which nobody has to wait for."""
    thread = threading.Thread(target=function, args=arguments, name=name, daemon=True)
    thread.start()
    return thread
