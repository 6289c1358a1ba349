"""Sessions of clients: limited in number, recognised by either of two cookies."""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import count
from time import monotonic
from typing import Final

HTTP_SESSION: Final = "-http-session-"
NUMBER: Final = "ABBCX"


@dataclass(slots=True)
class Session:
    """Session of one client."""

    number: int
    user: str
    scheme: str
    """Its cookies count only here: in `http` others may have read them, in `https` not."""
    cookies: Mapping[str, str]
    used_s: float
    sockets: int = 0
    """Number of its open websockets, with which it is never idle."""
    transfer: asyncio.Lock = field(default_factory=asyncio.Lock)
    """Held during the transfer of a file: a session has one at a time, and others come between."""

    def cookie_keys(self) -> Iterator[tuple[str, str, str]]:
        """Scheme, name and value of each cookie."""
        return ((self.scheme, *pair) for pair in self.cookies.items())


@dataclass(slots=True)
class Sessions:
    """All sessions."""

    most: int
    """Largest number of sessions at one time."""
    idle_s: float
    """Time [s] without use after which a session ends."""
    ended: Callable[[int], None]
    """Called with the number of each session that ends."""
    now_s: Callable[[], float] = monotonic
    _by_cookie: dict[tuple[str, str, str], Session] = field(default_factory=dict)
    _live: dict[int, Session] = field(default_factory=dict)
    _numbers: count[int] = field(default_factory=lambda: count(1))

    def __len__(self) -> int:
        """Number of sessions."""
        return len(self._live)

    def begin(self, user: str, scheme: str) -> Session | None:
        """Begin a session; None if there are too many."""
        self._drop_idle()
        if len(self._live) >= self.most:
            return None
        number = next(self._numbers)
        cookies = {
            HTTP_SESSION: f"{number}::http.session::{secrets.token_hex(16)}",
            NUMBER: str(secrets.randbits(62)),
        }
        session = Session(number, user, scheme, cookies, self.now_s())
        self._live[number] = session
        for key in session.cookie_keys():
            self._by_cookie[key] = session
        return session

    def find(self, cookies: Mapping[str, str], scheme: str) -> Session | None:
        """Return the session of a request, by any of its cookies; None if no session has them."""
        self._drop_idle()
        for pair in cookies.items():
            session = self._by_cookie.get((scheme, *pair))
            if session is not None:
                session.used_s = self.now_s()
                return session
        return None

    @contextmanager
    def listening(self, session: Session) -> Iterator[None]:
        """Keep a session while it has a websocket."""
        session.sockets += 1
        try:
            yield
        finally:
            session.sockets -= 1
            session.used_s = self.now_s()

    def end(self, session: Session) -> None:
        """End a session."""
        if self._live.pop(session.number, None) is not None:
            for key in session.cookie_keys():
                self._by_cookie.pop(key, None)
            self.ended(session.number)

    def end_all(self) -> None:
        """End all sessions."""
        for session in tuple(self._live.values()):
            self.end(session)

    def _drop_idle(self) -> None:
        latest = self.now_s() - self.idle_s
        idle = (one for one in self._live.values() if one.used_s < latest and not one.sockets)
        for session in tuple(idle):
            self.end(session)
