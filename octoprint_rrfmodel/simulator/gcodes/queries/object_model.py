"""M409: the object model."""

from __future__ import annotations

from typing import Any

from ...device.live_members import LiveMembers
from ...firmware import Firmware
from ...hardware.blank import INPUT_NAMES
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome, Running
from ...line.switches import FaultSwitches
from ...model.om import OUT_OF_BUFFERS, ModelText, dsf_reply
from ...model.tree import ObjectModel
from ...text.command import Command
from ...text.serial_line import NO_REPLY, Kind, Reply

KEY_LENGTH = 100
FLAGS_LENGTH = 20
"""Longest K and F of M409 (RRF 3.5 GCodes2.cpp:3111)."""


class ObjectModelCode:
    """Answers with parts of the object model as text."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        live: LiveMembers,
        model_text: ModelText,
        firmware: Firmware,
        faults: FaultSwitches,
    ):
        self._model = model
        self._live = live
        self._model_text = model_text
        self._firmware = firmware
        self._faults = faults

    def rows(self) -> Rows:
        return {
            "M409": Row(self._object_model, since=(3, 1)),
        }

    def _object_model(self, channel: Channel, command: Command) -> Outcome:
        """M409: the JSON text in one line, which ends in a line break of its own."""
        key = command.string("K", KEY_LENGTH) or ""
        flags = command.string("F", FLAGS_LENGTH) or ""
        channel.status_request = "M409"
        faults = self._faults
        if faults.take("no_reply"):
            return NO_REPLY
        if faults.is_on("few_buffers") and self._firmware.waits_for_buffers:
            return self._when_buffers_are_free(channel, key, flags)
        return self._model_reply(channel, key, flags, command.integer("R", 0) == 1)

    def _when_buffers_are_free(self, channel: Channel, key: str, flags: str) -> Running:
        """Retry silently below 20 free buffers, as 3.5 and later do."""
        yield self._has_buffers
        return self._model_reply(channel, key, flags, False)

    def _model_reply(self, channel: Channel, key: str, flags: str, itself: bool) -> Reply:
        self._live.refresh()
        model: dict[str, Any] = dict(self._model.data)
        state = model.get("state")
        if isinstance(state, dict) and "thisInput" in state:
            model["state"] = {**state, "thisInput": INPUT_NAMES.index(channel.name)}
        text = None
        if self._faults.is_on("sbc") and not itself:
            text = dsf_reply(model, key, flags)
        if text is None:
            if self._faults.is_on("few_buffers"):
                text = OUT_OF_BUFFERS
            else:
                exponents = self._faults.is_on("exponent")
                text = self._model_text.reply(model, key, flags, exponents=exponents)
                text = self._faults.model_text(text)
        return Reply(text + "\n", Kind.LONG)

    def _has_buffers(self) -> bool:
        return not self._faults.is_on("few_buffers")
