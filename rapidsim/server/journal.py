"""Journal of a controller: inputs from outside and events of the run, as lines of JSON.

Each line has the virtual time `t` at which it took effect, so the same requests at the same times
reproduce the same lines, byte for byte. No line contains a wall-clock time, a password or a cookie.
"""

from __future__ import annotations

import json
from base64 import b64decode, b64encode
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, ClassVar, Final

from rapidsim.controller.journal.events import Event
from rapidsim.files import InputError
from rapidsim.json_records.declarations import Key, ValueForm
from rapidsim.json_records.encoding import RecordEncoder, json_of, written
from rapidsim.json_records.reading import RecordReader
from rapidsim.language.errors import RapidError
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.server.messages import (
    NETWORK,
    BeginFault,
    EndFaults,
    ErrorAnswer,
    FromNetwork,
    Message,
    Reply,
    Request,
    SessionEnded,
    Subscribe,
    Unsubscribe,
)
from rapidsim.simulation.live.event_log import LogEntry
from rapidsim.simulation.live.states import Motors, OperatingMode
from rapidsim.simulation.results.event_values import event_record
from rapidsim.values import value_class

SENSOR: Final = "egm"
"""Kind of a line with a sensor's answer."""
REFUSED: Final = "network-refused"
"""Kind of an event in which the network refused a program."""
_MOST_LINE: Final = 128 * 2**20
"""Largest number of characters of a line: the largest upload in base 64, and room for the rest."""


@value_class(frozen=True, slots=True)
class PowerOnState:
    """The state of a controller when it was switched on."""

    kind: ClassVar[str] = "on"
    motors: Motors
    mode: Annotated[OperatingMode, Key("opmode")]
    robotware: Annotated[int, ValueForm.OPTIONAL] = 7
    """Version that Robot Web Services 2.0 reports: 7 or 8."""


@value_class(frozen=True, slots=True)
class _Refusal:
    """A refusal of the network."""

    kind: ClassVar[str] = REFUSED
    act: int
    """Number of the operation."""
    number: float
    """ERRNO."""
    message: str


@value_class(frozen=True, slots=True)
class RecordedInput:
    """An input from outside at a virtual time."""

    time_s: float
    message: Message


@value_class(frozen=True, slots=True)
class RecordedSession:
    """A complete journal."""

    began: PowerOnState
    recorded: tuple[RecordedInput, ...]
    refusals: Mapping[int, tuple[float, str]]
    """Error number and message of each refusal of the network, by the number of the operation."""
    answers: Mapping[int, SensorAnswer]
    """Answers of sensors, by the number of the exchange."""
    end_s: float
    """Time [s] of the switch-off of the controller, or of the last line."""
    lines: tuple[str, ...]
    """Lines of the file, unchanged."""


def switched_on_line(motors: Motors, mode: OperatingMode, robotware: int) -> str:
    """Return the first line."""
    return _line(0.0, "event", _encode(PowerOnState(motors, mode, robotware)))


def switched_off_line(time_s: float) -> str:
    """Return the last line."""
    return _line(time_s, "event", {"kind": "off"})


def event_line(event: Event) -> str:
    """Return the line of an event of the run."""
    record = json_of(event_record(event))
    del record["time_s"]
    return _line(written(event.time_s), "event", record)


def log_line(entry: LogEntry) -> str:
    """Return the line of an entry of the event log."""
    what = {
        "kind": "log",
        "domain": entry.domain,
        "type": entry.type,
        "code": entry.code,
        "title": entry.title,
        "message": entry.text,
    }
    return _line(written(entry.time_s), "event", what)


def refusal_line(time_s: float, act: int, error: RapidError) -> str:
    """Return the line of a refusal of the network, with the number of the operation."""
    return _line(time_s, "event", _encode(_Refusal(act, error.errno, error.message)))


def sensor_line(time_s: float, number: int, answer: SensorAnswer) -> str:
    """Return the line of the answer of a sensor, with the number of the exchange."""
    return _line(written(time_s), SENSOR, {"kind": "answer", "exchange": number, **_encode(answer)})


def request_line(time_s: float, message: Message, reply: Reply) -> str:
    """Return the line of an input from outside, with the status of its reply."""
    if isinstance(message, FromNetwork):
        return _line(time_s, "event", _encode(message))
    return _line(time_s, "request", {**_encode(message), "status": reply.status, **_code(reply)})


def read_journal(lines: Iterable[str], name: str) -> RecordedSession:
    """Read a journal; an incomplete last line is skipped.

    Args:
        lines: Lines of the file.
        name: Name of the file, for messages.

    Raises:
        InputError: If the lines are not a journal.
    """
    began: PowerOnState | None = None
    recorded, kept, end_s = list[RecordedInput](), list[str](), 0.0
    refusals: dict[int, tuple[float, str]] = {}
    answers: dict[int, SensorAnswer] = {}
    for number, line in enumerate(lines, start=1):
        if not line.endswith("\n"):
            break
        try:
            if len(line) > _MOST_LINE:
                raise ValueError("too long")
            read = json.loads(line)
            time_s, kind, what = float(read["t"]), read["kind"], read["what"]
            is_asked = kind == "request" or what["kind"] == NETWORK
            if not end_s <= time_s < float("inf"):
                # Events are written once their time is known; requests immediately.
                if is_asked:
                    raise ValueError("time goes back")
                time_s = end_s
            if is_asked:
                recorded.append(RecordedInput(time_s, _message(what)))
            elif kind == SENSOR:
                answers[int(what["exchange"])] = _read(SensorAnswer, what)
            elif what["kind"] == REFUSED:
                refusal = _read(_Refusal, what)
                refusals[refusal.act] = (refusal.number, refusal.message)
            elif what["kind"] == "on" and began is None:
                began = _read(PowerOnState, what)
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
            raise InputError(f"{name}, line {number}: this is no line of a journal") from None
        if is_asked or what["kind"] == "off":
            end_s = time_s
        kept.append(line)
    if began is None:
        raise InputError(
            f"{name} is no journal of a controller", "`rapidsim serve --journal` writes one"
        )
    return RecordedSession(began, tuple(recorded), refusals, answers, end_s, tuple(kept))


class JournalFile:
    """Line-by-line writer of a journal: all lines are complete, however the process ends."""

    def __init__(self, path: Path, failed: Callable[[str], None]) -> None:
        """Open the journal; a write error is reported once, by `failed`.

        Raises:
            InputError: If the file cannot be opened.
        """
        self._path, self._failed = path, failed
        try:
            # Line by line: `buffering=1`.
            self._file = path.open("w", encoding="utf-8", newline="", buffering=1)
        except OSError as error:
            raise InputError(f"--journal: {path}: {error.strerror or error}") from None
        self._is_whole = True

    def write(self, line: str) -> None:
        """Append a line."""
        try:
            if self._is_whole:
                self._file.write(line)
        except OSError as error:
            self._is_whole = False
            self._failed(f"error: the journal {self._path} has ended: {error.strerror or error}")

    def close(self) -> None:
        """Close the file, which writes the last line."""
        with suppress(OSError):
            self._file.close()


def _line(time_s: float, kind: str, record: Mapping[str, object]) -> str:
    read = {"t": time_s, "kind": kind, "what": record}
    return json.dumps(read, ensure_ascii=False, allow_nan=False) + "\n"


def _code(reply: Reply) -> dict[str, object]:
    return {"code": reply.code} if isinstance(reply, ErrorAnswer) else {}


_KINDS: Mapping[str, type[Message]] = MappingProxyType(
    {
        "connection": FromNetwork,
        "fault": BeginFault,
        "end_faults": EndFaults,
        "end_of_session": SessionEnded,
        "subscribe": Subscribe,
        "unsubscribe": Unsubscribe,
        "method": Request,
    }
)
"""Messages by a key that only they have."""
_encode = RecordEncoder({bytes: lambda content: b64encode(content).decode()})
_read = RecordReader({bytes: lambda text: b64decode(str(text), validate=True)})


def _message(record: Mapping[str, object]) -> Message:
    """Read a message; errors of the conversions are raised unchanged."""
    kind = next((kind for key, kind in _KINDS.items() if key in record), Request)
    message = _read(kind, record)
    if isinstance(message, Request) and message.generation not in (1, 2):
        raise ValueError("no generation")
    return message
