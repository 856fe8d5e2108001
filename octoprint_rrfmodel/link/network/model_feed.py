"""The model of a computer in front of a board, as its websocket tells it.

The whole model comes first, then a patch for each ``OK`` (DSF WebSocketController.cs). Where a
patch is none of the model that is known, the whole is fetched again, by a new websocket: what is
told by the next patch goes by what the same websocket has told before.
"""

import contextlib
import json
import logging
import threading
from socket import SHUT_RDWR

from ...rrf.model import dsf
from ...rrf.wire.machine import MODEL_SOCKET
from .login import DOWN, Refused
from .session import SessionLost
from .transport import Unreachable

ANSWER_SECONDS = 5.0

QUIET_SECONDS = 2.0
"""Time without a message after which it is asked whether anybody is there."""

MOST_BYTES = 8 * 1024 * 1024
"""Of one message, or of the answer to a handshake."""

AGAIN_SECONDS = 10.0
"""Where the next patch doesn't fit either, so soon after, it is taken for a gap."""

EVERYTHING = "verbose=true&obsolete=true"
"""What later frameworks leave out of the model unless asked (DSF WebSocketEndpoint.cs)."""

ACKNOWLEDGED, ASKS, IS_THERE = "OK\n", "PING\n", b"PONG\n"


class ModelFeed:
    """Follows the model behind ``session``; ``wake()`` is called when there are messages."""

    def __init__(self, session, clock, wake):
        self._session = session
        self._clock = clock
        self._wake = wake
        self._lock = threading.Lock()
        self._opening = threading.Lock()
        self._socket = None
        self._told = None
        self._messages = []
        self._why = "no connection"
        self._again_at = None
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.network")
        self.heard_at = 0.0
        """When something was heard last."""

    @property
    def is_open(self):
        """Whether the model is followed."""
        return self._socket is not None

    @property
    def has_messages(self):
        """Whether the machine has said something that was not taken yet."""
        return bool(self._messages)

    @property
    def model(self):
        """The model as it was told last, an empty one before."""
        told = self._told
        return told.model if told else {}

    def open(self):
        """Begin to follow; this network's exceptions say why that isn't possible."""
        with self._opening:
            self.close()
            self._begin(self._connected(), None)

    def close(self):
        """Follow no more."""
        with self._lock:
            socket, self._socket = self._socket, None
        if socket is not None:
            _end(socket)

    def take(self):
        """Return the model, and what was said before it came to be so; ``Unreachable`` without."""
        with self._lock:
            if self._socket is None:
                raise Unreachable(self._why)
            said, self._messages = self._messages, []
            return self._told.model, said

    def taken_messages(self):
        """Return what was said, whether the model is followed or not."""
        with self._lock:
            said, self._messages = self._messages, []
            return said

    def look_at_card(self):
        """Let the model say that files of the card may have changed."""
        with self._lock:
            self._told = dsf.with_another_card(self._told)

    ##~~ opening it

    def _connected(self):
        # OctoPrint brings it along; without a computer in front of a board nobody needs it
        import websocket

        try:
            address, connected, key = self._session.connected()
        except OSError as error:
            raise Unreachable(_why(error)) from None
        scheme = "wss" if address.scheme == "https" else "ws"
        host = f"[{address.host}]" if ":" in address.host else address.host
        connected.settimeout(ANSWER_SECONDS)
        made = websocket.WebSocket(skip_utf8_validation=True)
        try:
            # a connection that is there already: no proxy, no look-up of the name, no redirect
            made.connect(
                f"{scheme}://{host}:{address.port}{MODEL_SOCKET}?sessionKey={key}&{EVERYTHING}",
                socket=_Bounded(connected),
                suppress_origin=True,
                redirect_limit=0,
                timeout=ANSWER_SECONDS,
            )
        except websocket.WebSocketBadStatusException as error:
            connected.close()
            if error.status_code in (401, 403):
                self._session.lose()
                raise SessionLost from None
            raise Refused("sbc_down" if error.status_code in DOWN else "not_rrf") from None
        except (websocket.WebSocketException, OSError, ValueError) as error:
            connected.close()
            raise Unreachable(_why(error)) from None
        return made

    def _begin(self, socket, before):
        """Take the whole model, and go on with patches on a thread of their own.

        ``before`` is the websocket that is in use until then: where it isn't any more nobody
        wants this one.
        """
        try:
            whole = self._received(socket)
            told = dsf.begun(json.loads(whole), self._told)
            self._send(socket, ACKNOWLEDGED)
        except (dsf.Unpatchable, ValueError, RecursionError):
            socket.shutdown()
            raise Unreachable("what it tells is no model") from None
        except Unreachable:
            socket.shutdown()
            raise
        with self._lock:
            if self._socket is not before:
                socket.shutdown()
                return
            self._socket = socket
            self._keep(told)
        threading.Thread(
            target=self._follow, args=(socket,), name="rrfmodel.model", daemon=True
        ).start()

    ##~~ on that thread

    def _follow(self, socket):
        try:
            while socket is self._socket:
                patch = json.loads(self._received(socket))
                with self._lock:
                    if socket is not self._socket:
                        return
                    self._keep(dsf.after(self._told, patch))
                if self._messages:
                    self._wake()
                self._send(socket, ACKNOWLEDGED)
        except Unreachable as error:
            self._lose(socket, str(error))
        except (dsf.Unpatchable, ValueError, RecursionError):
            self._fetch_again(socket)
        finally:
            socket.shutdown()

    def _keep(self, told):
        self._told = told
        self._messages += told.messages

    def _fetch_again(self, socket):
        """Begin anew with the whole model, once in a while."""
        now, before = self._clock(), self._again_at
        self._again_at = now
        if before is not None and now - before < AGAIN_SECONDS:
            self._lose(socket, "what it tells doesn't fit together")
            return
        self._logger.info("A patch of the model doesn't fit: the whole is fetched again")
        try:
            with self._opening:
                # what was known is answered until the other one is there
                self._begin(self._connected(), socket)
        except (Unreachable, SessionLost, Refused) as error:
            self._lose(socket, str(error) or "the session was lost")

    def _lose(self, socket, why):
        with self._lock:
            if socket is self._socket:
                self._socket, self._why = None, why
        self._wake()

    def _received(self, socket):
        """Return the next message; asks whether anybody is there where none comes."""
        import websocket

        is_asked = False
        while True:
            try:
                if not is_asked:
                    socket.sock.begin()
                socket.settimeout(ANSWER_SECONDS if is_asked else QUIET_SECONDS)
                kind, data = socket.recv_data()
            except websocket.WebSocketTimeoutException:
                if is_asked:
                    raise Unreachable("no answer in time") from None
                self._send(socket, ASKS)
                is_asked = True
                continue
            except (websocket.WebSocketException, OSError, ValueError, AttributeError) as error:
                raise Unreachable(_why(error)) from None
            if kind == websocket.ABNF.OPCODE_CLOSE:
                raise Unreachable("it has ended the connection")
            self.heard_at, is_asked = self._clock(), False
            if data != IS_THERE:
                return data

    def _send(self, socket, text):
        import websocket

        try:
            socket.send(text)
        except (websocket.WebSocketException, OSError, AttributeError) as error:
            raise Unreachable(_why(error)) from None


class _Bounded:
    """A socket from which no more than so many bytes are read in one go."""

    def __init__(self, connected):
        self._connected = connected
        self._left = MOST_BYTES

    def begin(self):
        """Count anew: another message comes."""
        self._left = MOST_BYTES

    def recv(self, count):
        data = self._connected.recv(count)
        self._left -= len(data)
        if self._left < 0:
            raise OSError("more was told than makes sense")
        return data

    def __getattr__(self, name):
        return getattr(self._connected, name)


def _end(socket):
    """End a websocket; who reads from it finds out, and closes it."""
    with contextlib.suppress(OSError, AttributeError):
        socket.sock.shutdown(SHUT_RDWR)


def _why(error):
    """Return what went wrong, without what was asked: there is a key in it."""
    name = type(error).__name__
    return "no answer in time" if "Timeout" in name else "the connection was lost"
