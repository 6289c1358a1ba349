"""Faults of a controller and its connections, which a station or a test causes on purpose."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import Annotated, Final, Literal

from rapidsim.controller.cell.occasions import Occasion
from rapidsim.json_records.declarations import (
    AboveZero,
    Key,
    OneOf,
    Required,
    noun,
    whole_number,
)
from rapidsim.values import value_class


class FailureKind(StrEnum):
    """Kinds of faults."""

    EMERGENCY_STOP = "emergency_stop"
    GUARD_STOP = "guard_stop"
    GENERAL_STOP = "general_stop"
    RESTART = "restart"
    DROP = "drop"
    DELAY = "delay"
    DUPLICATE = "duplicate"
    REFUSE = "refuse"
    FULL_DISK = "full_disk"
    ELOG = "elog"
    DEVICE_LOST = "device_lost"


class Channel(StrEnum):
    """Connections of a controller."""

    HTTP = "http"
    """Requests of Robot Web Services and their answers."""
    WEBSOCKET = "websocket"
    """Events of subscriptions."""
    EGM = "egm"
    """Datagrams from and to sensors that guide robots."""
    SOCKET = "socket"
    """Bytes and datagrams that arrive for programs."""


_LASTING: Final = ("for", "count")
KEYS: Final[Mapping[FailureKind, tuple[str, ...]]] = MappingProxyType(
    {
        FailureKind.EMERGENCY_STOP: ("for",),
        FailureKind.GUARD_STOP: ("for",),
        FailureKind.GENERAL_STOP: ("for",),
        FailureKind.RESTART: ("mode", "for"),
        FailureKind.DROP: ("on", *_LASTING),
        FailureKind.DELAY: ("on", "by", *_LASTING),
        FailureKind.DUPLICATE: ("on", *_LASTING),
        FailureKind.REFUSE: ("on", *_LASTING),
        FailureKind.FULL_DISK: ("for",),
        FailureKind.ELOG: ("code", "severity", "title", "texts"),
        FailureKind.DEVICE_LOST: ("device", "for"),
    }
)
"""Further keys by kind; those of other kinds are refused."""
_KIND: Final = Required('name the kind, as in kind = "emergency_stop"')


@value_class(frozen=True, slots=True, kw_only=True)
class Fault(Occasion):
    """Something that goes wrong."""

    kind: Annotated[FailureKind, noun("a kind of fault"), _KIND]
    """The kind of fault."""
    for_s: Annotated[AboveZero | None, Key("for")] = None
    """Time after which it ends; None if it lasts until it is ended. Of a restart: real time for
    which clients cannot connect, 1 s by default."""
    on: Annotated[Channel, noun("a connection")] = Channel.HTTP
    """Connection that drops, delays, duplicates or refuses."""
    by_s: Annotated[AboveZero, Key("by")] = 1.0
    """Delay: of HTTP and websockets in real time, of others in virtual time."""
    count: Annotated[int | None, whole_number(1, 1_000_000)] = None
    """Number of requests, events, messages or connections after which it ends; None for all."""
    mode: Annotated[Literal["warm", "cold"], OneOf('"warm" or "cold" is needed')] = "warm"
    """Whether a restart keeps programs and data, or begins with initial values."""
    device: str = ""
    """The I/O device that is lost."""
    code: Annotated[int, whole_number(10_000, 159_999)] = 20_000
    """Number of the entry of the event log; its domain is the part before the last 4 digits."""
    severity: Annotated[
        Literal["information", "warning", "error"],
        OneOf('"information", "warning" or "error" is needed'),
    ] = "error"
    """Type of the entry."""
    title: str = "Fault"
    """Title of the entry."""
    texts: tuple[str, ...] = ()
    """Texts of the entry, at most five."""

    @property
    def lasts(self) -> bool:
        """Whether it has an end, rather than being over at once."""
        return self.kind not in (FailureKind.RESTART, FailureKind.ELOG)

    @property
    def is_of_connection(self) -> bool:
        """Whether a connection fails, not the controller."""
        return "on" in KEYS[self.kind]


@value_class(frozen=True, slots=True)
class LastingFault:
    """A fault that has begun and not ended."""

    number: int
    """Ascends in the order in which faults begin."""
    fault: Fault
