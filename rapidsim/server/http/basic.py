"""Basic authentication (RFC 7617), for connections that nobody reads along."""

from __future__ import annotations

import hmac
from base64 import b64decode
from binascii import Error
from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class BasicAuthentication:
    """Who may come in."""

    users: Mapping[str, str]
    """Passwords by name."""
    challenge: str = 'Basic realm="validusers@robapi.abb"'

    def user(self, header: str, method: str, target: str) -> str | None:
        """Who sends a header; None if nobody who may come in; see `dialect.Users`."""
        del method, target
        scheme, _, rest = header.partition(" ")
        try:
            name, _, given = b64decode(rest.strip(), validate=True).decode().partition(":")
        except (Error, UnicodeDecodeError, ValueError):
            return None
        password = self.users.get(name)
        # Compared even where there is no such name, so that the time does not tell.
        right = hmac.compare_digest(given.encode(), (password or "").encode())
        return name if right and password is not None and scheme.lower() == "basic" else None
