"""What every resource is given: the controller, and what sessions hold."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, TypeAlias, TypeVar

from rapidsim.controller.cell.message_queues import MessageQueue
from rapidsim.server.messages import Answer, Fields, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, HELD_BY_ANOTHER, NOT_HELD, refused
from rapidsim.server.resources.disks import FileService
from rapidsim.simulation.live.controller import LiveController

MASTERSHIPS: Final = ("cfg", "motion", "rapid")

T = TypeVar("T")


@dataclass(slots=True)
class RequestContext:
    """The controller, and which session holds which mastership."""

    live: LiveController
    masters: dict[str, int] = field(default_factory=dict)
    """The session that holds each domain."""
    queues: dict[str, MessageQueue] = field(default_factory=dict)
    """The message queues of clients, by name, in the case they were created with."""
    owners: dict[str, int] = field(default_factory=dict)
    """The session that made each of them."""
    files: FileService = field(init=False)

    def __post_init__(self) -> None:
        """Open the folders of its programs."""
        options = self.live.options
        ramdisk = None if options.ramdisk is None else options.ramdisk.resolve()
        self.files = FileService((options.home or Path("HOME")).resolve(), ramdisk)

    def require_mastership(self, domain: str, request: Request) -> None:
        """Refuse if another session holds a mastership.

        RobotWare 6 takes it implicitly if nobody holds it, RobotWare 7 does not.

        Raises:
            RefusedRequest: If another session holds it, or it must be held and is not.
        """
        holder = self.masters.get(domain)
        if holder == request.session:
            return
        if holder is not None:
            raise refused(HELD_BY_ANOTHER, f"another session has the mastership of {domain}")
        if request.generation == 2:
            raise refused(NOT_HELD, f"this takes the mastership of {domain}")

    def require_unclaimed(self, request: Request) -> None:
        """Refuse to start what another session is master of, as RobotWare 7 does.

        Raises:
            RefusedRequest: If it is.
        """
        if (
            request.generation == 2
            and self.masters.get("rapid", request.session) != request.session
        ):
            raise refused(HELD_BY_ANOTHER, "another session has the mastership of edit")

    def release_all(self, session: int) -> None:
        """Release what a session holds."""
        self.masters = {key: one for key, one in self.masters.items() if one != session}
        for name in [name for name, owner in self.owners.items() if owner == session]:
            self.live.cell.messages.disconnect(name)
            del self.queues[name], self.owners[name]


Resource: TypeAlias = Callable[..., Answer]
"""Called with the context, the request, and the parameters of its address by name."""


def required_value(form: Fields, name: str) -> str:
    """A value that a request must give.

    Raises:
        RefusedRequest: If it does not.
    """
    value = form.get(name)
    if value is None:
        raise refused(BAD_PARAMETER, f"`{name}` is missing")
    return value


def chosen(form: Fields, name: str, words: Callable[[str], T]) -> T:
    """A value that must be one of a set of words; see `required_value`.

    Raises:
        RefusedRequest: If it is not.
    """
    text = required_value(form, name)
    try:
        return words(text)
    except ValueError:
        raise refused(BAD_PARAMETER, f"`{name}` cannot be `{text}`") from None


def number(form: Fields, name: str) -> float:
    """A finite number that a request must give; see `required_value`.

    Raises:
        RefusedRequest: If it is none.
    """
    value = chosen(form, name, float)
    if not abs(value) < float("inf"):
        raise refused(BAD_PARAMETER, f"`{name}` cannot be `{form[name]}`")
    return value


def count(form: Fields, name: str, default: int) -> int:
    """A count that a request may give.

    Raises:
        RefusedRequest: If it is none.
    """
    text = form.get(name, str(default))
    if not (text.isascii() and text.isdecimal() and len(text) < 10):
        raise refused(BAD_PARAMETER, f"`{name}` cannot be `{text}`")
    return int(text)
