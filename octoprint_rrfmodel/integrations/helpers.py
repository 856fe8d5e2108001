"""What other plugins get from ``get_helpers("rrfmodel")``; any thread may call it."""

from ..link.poll_slot import TooManyQueries
from ..link.questions import refusal_to_send
from ..rrf import klipper
from ..rrf.model.frozen import frozen
from ..rrf.model.keys import value_at
from .answers import Answer


class Helpers:
    """The model, changes, questions, commands, the state and the printer objects.

    ``model()`` is the snapshot, ``subscribe(path, callback)`` notes who listens, ``questions`` are
    ``link.questions.Questions``, ``command(name, **parameters)`` queues a command or raises
    ``ValueError``, ``status()`` gives the plugin's state.
    """

    def __init__(self, model, subscribe, questions, *, command, status, objects):
        self._model = model
        self._subscribe = subscribe
        self._questions = questions
        self._command = command
        self._status = status
        self._objects = objects

    def by_name(self):
        """Return the helpers by their names, in OctoPrint's form."""
        return {
            "get": self.get,
            "subscribe": self._subscribe,
            "query": self.query,
            "command": self._command,
            "status": self._status,
            "objects": self.objects,
        }

    def get(self, path="", default=None):
        """Return the value at a key as it is known now, ``default`` where there is none.

        The value can't be changed: it is one moment's, however long it is kept.
        """
        return frozen(value_at(self._model(), path, default))

    def query(self, key, flags=""):
        """Return a future of the printer's own answer; its callbacks may take their time.

        Raises ``ValueError`` for a key or flags that can't be sent. The future fails with a
        ``RuntimeError`` that says why, where the printer can't be asked or doesn't answer.
        """
        reason = refusal_to_send(key, flags)
        if reason:
            raise ValueError(reason)
        result = Answer()
        reason = self._questions.refusal()
        if reason:
            result.set_exception(RuntimeError(reason))
            return result
        try:
            reply = self._questions.ask(key, flags)
        except TooManyQueries:
            result.set_exception(RuntimeError("Four questions wait for the printer already."))
            return result
        reply.add_done_callback(lambda done: _pass_on(done, result))
        return result

    def objects(self, names=None):
        """Return Klipper's printer objects with all fields, all of them or those named."""
        wanted = self._objects.names() if names is None else names
        return self._objects.query(klipper.wanted_of(dict.fromkeys(wanted)))["status"]


def _pass_on(reply, result):
    if not result.set_running_or_notify_cancel():
        return
    error = reply.exception()
    if error is not None:
        result.set_exception(error)
    else:
        result.set_result(reply.result().result)
