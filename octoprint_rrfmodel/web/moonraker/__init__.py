"""Klipper's printer objects in Moonraker's forms, over HTTP and a websocket."""
