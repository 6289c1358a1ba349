"""Journal of a controller: inputs from outside and events of the run, as lines of JSON.

Each line has the virtual time `t` at which it took effect, so the same requests at the same times
reproduce the same lines, byte for byte. No line contains a wall-clock time, a password or a cookie.
"""

from __future__ import annotations

import json
import math
from base64 import b64decode, b64encode
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, Final

from rapidsim.controller.journal.events import Event
from rapidsim.files import InputError
from rapidsim.json_records.encoding import json_of, written
from rapidsim.language.errors import RapidError
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.server.messages import (
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

NETWORK: Final = "network"
"""Kind of an event caused by a peer of a program's socket."""
SENSOR: Final = "egm"
"""Kind of a line with a sensor's answer."""
REFUSED: Final = "network-refused"
"""Kind of an event in which the network refused a program."""
_MOST_LINE: Final = 128 * 2**20
"""Largest number of characters of a line: the largest upload in base 64, and room for the rest."""


@value_class(frozen=True, slots=True)
class PowerOnState:
    """The state of a controller when it was switched on."""

    motors: Motors
    mode: OperatingMode


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


def switched_on_line(motors: Motors, mode: OperatingMode) -> str:
    """Return the first line."""
    return _line(0.0, "event", {"kind": "on", "motors": motors.value, "opmode": mode.value})


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
    what = {"kind": REFUSED, "act": act, "number": error.errno, "message": error.message}
    return _line(time_s, "event", what)


def sensor_line(time_s: float, number: int, answer: SensorAnswer) -> str:
    """Return the line of the answer of a sensor, with the number of the exchange."""
    said = {name: list(part) for name, part in asdict(answer).items() if part}
    return _line(written(time_s), SENSOR, {"kind": "answer", "exchange": number, **said})


def request_line(time_s: float, message: Message, reply: Reply) -> str:
    """Return the line of an input from outside, with the status of its reply."""
    if isinstance(message, FromNetwork):
        return _line(time_s, "event", _message_record(message))
    return _line(
        time_s, "request", {**_message_record(message), "status": reply.status, **_code(reply)}
    )


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
                answers[int(what["exchange"])] = _answer(what)
            elif what["kind"] == REFUSED:
                refusals[int(what["act"])] = (float(what["number"]), str(what["message"]))
            elif what["kind"] == "on" and began is None:
                began = PowerOnState(Motors(what["motors"]), OperatingMode(what["opmode"]))
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


def _message_record(message: Message) -> dict[str, object]:
    match message:
        case Request():
            what: dict[str, object] = {
                "method": message.method,
                "path": message.path,
                "query": dict(message.query),
                "form": dict(message.form),
                "session": message.session,
            }
            if message.generation != 1:
                what["generation"] = message.generation
            if message.content:
                what["content"] = b64encode(message.content).decode()
            return what
        case SessionEnded(session):
            return {"end_of_session": session}
        case Subscribe(group, resources):
            return {"subscribe": list(resources), "group": group}
        case Unsubscribe(group):
            return {"unsubscribe": group}
        case FromNetwork(number, port, peer, data, is_over):
            return {
                "kind": NETWORK,
                "connection": number,
                "port": port,
                "peer": peer,
                "data": b64encode(data).decode(),
                "over": is_over,
            }


def _message(record: Mapping[str, object]) -> Message:
    """Invert `_message_record`; errors of the conversions are raised unchanged."""
    match record:
        case {
            "connection": int(number),
            "port": int(port),
            "peer": str(peer),
            "data": str(data),
            "over": bool(is_over),
        }:
            return FromNetwork(number, port, peer, b64decode(data, validate=True), is_over)
        case {"end_of_session": int(session)}:
            return SessionEnded(session)
        case {"subscribe": [*resources], "group": int(group)}:
            return Subscribe(group, tuple(map(str, resources)))
        case {"unsubscribe": int(group)}:
            return Unsubscribe(group)
        case {
            "method": str(method),
            "path": str(path),
            "query": {**query},
            "form": {**form},
            "session": int(session),
        }:
            content = b64decode(str(record.get("content", "")), validate=True)
            generation = int(str(record.get("generation", 1)))
            if generation not in (1, 2):
                raise ValueError("no generation")
            return Request(method, path, _texts(query), _texts(form), session, content, generation)
        case _:
            raise ValueError("no message")


def _answer(record: Mapping[str, Any]) -> SensorAnswer:
    """Invert `sensor_line`; errors of the conversions are raised unchanged."""
    parts = {
        one.name: tuple(map(float, record[one.name]))
        for one in fields(SensorAnswer)
        if one.name in record
    }
    if not all(math.isfinite(value) for part in parts.values() for value in part):
        raise ValueError("not finite")
    return SensorAnswer(**parts)


def _texts(fields: Mapping[object, object]) -> dict[str, str]:
    return {str(key): str(value) for key, value in fields.items()}
