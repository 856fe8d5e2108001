"""OctoPrint's webcams in Moonraker's form."""

import ipaddress
from urllib.parse import urlsplit

SERVICES = {"webrtc": "webrtc-camerastreamer", "hls": "hlsstream", "mjpeg": "mjpegstreamer"}
"""Mainsail's names of the kinds of streams that OctoPrint knows (its ``helpers.js``)."""

COUNTERCLOCKWISE_90 = 270
"""Moonraker turns clockwise."""


def webcam(provided, is_on):
    """Return one of OctoPrint's webcams, ``None`` for one whose stream others can't show.

    ``provided`` is its ``ProvidedWebcam``, ``is_on`` whether OctoPrint shows any.
    """
    config = provided.config
    stream = (config.compat.stream or "") if config.compat else ""
    if not stream:
        return None
    kind, address = _stream(stream)
    return {
        "name": config.displayName or config.name,
        "location": "printer",
        "service": SERVICES[kind],
        "enabled": is_on,
        "icon": "mdiWebcam",
        "target_fps": 15,
        "target_fps_idle": 5,
        "stream_url": address,
        "snapshot_url": _snapshot(config.compat.snapshot or ""),
        "flip_horizontal": config.flipH,
        "flip_vertical": config.flipV,
        "rotation": COUNTERCLOCKWISE_90 if config.rotate90 else 0,
        "aspect_ratio": getattr(config.compat.streamRatio, "value", config.compat.streamRatio),
        "extra_data": {},
        # it can't be changed here
        "source": "config",
        "uid": f"{provided.providerIdentifier}:{config.name}",
    }


def _stream(address):
    """Return the kind of a stream and the address for a client of that kind."""
    found = urlsplit(address)
    if found.scheme in ("webrtc", "webrtcs"):
        return "webrtc", "http" + address[len("webrtc") :]
    return ("hls" if found.path.lower().endswith(".m3u8") else "mjpeg"), address


def _snapshot(address):
    """Return the address of a snapshot where others can use it: OctoPrint fetches by itself.

    Many are of this very computer, and some have a password in them.
    """
    found = urlsplit(address)
    if found.username is not None or _is_here(found.hostname):
        return ""
    return address


def _is_here(host):
    if host is None:
        return False
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host.lower() == "localhost"
