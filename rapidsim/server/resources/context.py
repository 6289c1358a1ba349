"""Context of a request: the controller, and the resources held by sessions."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, TypeAlias, TypeVar

from rapidsim.controller.cell.message_queues import MessageQueue
from rapidsim.server.messages import Answer, Fields, Request
from rapidsim.server.resources.codes import (
    BAD_PARAMETER,
    HELD_BY_ANOTHER,
    NO_WRITE_ACCESS,
    NOT_HELD,
    refused,
)
from rapidsim.server.resources.disks import FileService
from rapidsim.server.versions import ServedVersion, served_versions
from rapidsim.simulation.live.controller import LiveController
from rapidsim.values import value_class

MASTERSHIPS: Final = ("cfg", "motion", "rapid")

T = TypeVar("T")


@value_class(frozen=True, slots=True)
class ControlStation:
    """A client that may request write access in RobotWare 8."""

    identity: str
    """GUID in braces."""
    name: str
    ends_with_session: bool = field(default=False, compare=False)
    """Whether the end of its session releases the write access."""


@dataclass(slots=True)
class RequestContext:
    """The controller, and the holders of masterships."""

    live: LiveController
    versions: Mapping[int, ServedVersion] = field(default_factory=lambda: served_versions(None))
    """Version of RobotWare that each generation of Robot Web Services reports."""
    masters: dict[str, int] = field(default_factory=dict)
    """Session that holds each domain."""
    operations: list[str] = field(default_factory=list)
    """Titles of the operations that were answered before they had ended, as on a controller."""
    sessions: dict[int, str] = field(default_factory=dict)
    """Sessions that have requested something, with the names that they have registered."""
    rights: dict[int, str] = field(default_factory=dict)
    """Rights in manual mode, by session."""
    stations: dict[int, ControlStation] = field(default_factory=dict)
    """Control station of each session that has registered."""
    writer: ControlStation | None = None
    """Control station that may write, in RobotWare 8."""
    is_access_exclusive: bool = False
    """Whether others cannot take the write access: until the station has written."""
    appeals: int = 0
    """Number of requests to release the write access."""
    queues: dict[str, MessageQueue] = field(default_factory=dict)
    """Message queues of clients, by name, in the case they were created with."""
    owners: dict[str, int] = field(default_factory=dict)
    """Session that created each queue."""
    files: FileService = field(init=False)
    _folders: tuple[str, ...] = field(init=False)
    """Folders of the programs on this computer, those inside others first."""

    def __post_init__(self) -> None:
        """Open the folders of the programs."""
        options = self.live.options
        ramdisk = None if options.ramdisk is None else options.ramdisk.resolve()
        self.files = FileService(
            (options.home or Path("HOME")).resolve(), ramdisk, self.live.cell.home.disk
        )
        modules = (module for one in self.live.setups for module in one.program.modules)
        folders = {Path(module.source.file).absolute().parent for module in modules}
        folders |= {one for one in (options.home, options.ramdisk) if one is not None}
        names = {str(one) for folder in folders for one in (folder, folder.resolve())}
        self._folders = tuple(sorted(names, key=len, reverse=True))

    def without_paths(self, message: str) -> str:
        """Return a message without the places of its files on this computer."""
        for folder in self._folders:
            message = message.replace(f"{folder}{os.sep}", "").replace(folder, "HOME:")
        return message

    @property
    def has_control_stations(self) -> bool:
        """Whether control stations take the place of masterships, as in RobotWare 8."""
        return self.versions[2].robotware.major >= 8

    def require_mastership(self, domain: str, request: Request) -> None:
        """Refuse if another session holds a mastership, or in RobotWare 8 the write access.

        RobotWare 6 takes it implicitly if no session holds it, later ones do not.

        Raises:
            RefusedRequest: If another session holds it, or it is required and not held.
        """
        if request.generation == 2 and self.has_control_stations:
            station = self.stations.get(request.session)
            if station is None or station != self.writer:
                raise refused(NO_WRITE_ACCESS, "The control station does not have SPoC.")
            self.is_access_exclusive = False
            return
        holder = self.masters.get(domain)
        if holder == request.session:
            return
        if holder is not None:
            raise refused(HELD_BY_ANOTHER, f"another session has the mastership of {domain}")
        if request.generation == 2:
            raise refused(NOT_HELD, f"this takes the mastership of {domain}")

    def require_unclaimed(self, request: Request) -> None:
        """Refuse to start programs if another session has the mastership, as RobotWare 7 does.

        Raises:
            RefusedRequest: If another session holds it.
        """
        if self.has_control_stations and request.generation == 2:
            if self.is_access_exclusive and self.stations.get(request.session) != self.writer:
                raise refused(NO_WRITE_ACCESS, "The control station does not have SPoC.")
        elif (
            request.generation == 2
            and self.masters.get("rapid", request.session) != request.session
        ):
            raise refused(HELD_BY_ANOTHER, "another session has the mastership of edit")

    def queue_of(self, name: str, session: int) -> MessageQueue | None:
        """Return the queue of a client by name; None if no queue of this session has it."""
        return self.queues.get(name) if self.owners.get(name) == session else None

    def release_all(self, session: int) -> None:
        """Release all resources held by a session."""
        self.sessions.pop(session, None)
        self.rights.pop(session, None)
        station = self.stations.pop(session, None)
        if station is not None and station.ends_with_session and station == self.writer:
            self.writer, self.is_access_exclusive = None, False
        self.masters = {key: one for key, one in self.masters.items() if one != session}
        for name in [name for name, owner in self.owners.items() if owner == session]:
            self.live.cell.messages.disconnect(name)
            del self.queues[name], self.owners[name]


Resource: TypeAlias = Callable[..., Answer]
"""Called with the context, the request, and the parameters of its address by name."""


def required_value(form: Fields, name: str) -> str:
    """Return a required value of a request.

    Raises:
        RefusedRequest: If it is missing.
    """
    value = form.get(name)
    if value is None:
        raise refused(BAD_PARAMETER, f"`{name}` is missing")
    return value


def chosen(form: Fields, name: str, words: Callable[[str], T]) -> T:
    """Return a value that must be one of a set of words; see `required_value`.

    Raises:
        RefusedRequest: If it is none of them.
    """
    text = required_value(form, name)
    try:
        return words(text)
    except ValueError:
        raise refused(BAD_PARAMETER, f"`{name}` cannot be `{text}`") from None


def number(form: Fields, name: str) -> float:
    """Return a finite number that is required in a request; see `required_value`.

    Raises:
        RefusedRequest: If it is not a finite number.
    """
    value = chosen(form, name, float)
    if not abs(value) < float("inf"):
        raise refused(BAD_PARAMETER, f"`{name}` cannot be `{form[name]}`")
    return value


def count(form: Fields, name: str, default: int) -> int:
    """Return an optional count of a request.

    Raises:
        RefusedRequest: If it is not a count.
    """
    text = form.get(name, str(default))
    if not (text.isascii() and text.isdecimal() and len(text) < 10):
        raise refused(BAD_PARAMETER, f"`{name}` cannot be `{text}`")
    return int(text)
