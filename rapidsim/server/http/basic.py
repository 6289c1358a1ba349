"""Basic authentication (RFC 7617), for encrypted connections."""

from __future__ import annotations

import hmac
from base64 import b64decode
from binascii import Error
from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class BasicAuthentication:
    """Users that are admitted with Basic authentication."""

    users: Mapping[str, str]
    """Passwords by name."""
    challenge: str = 'Basic realm="validusers@robapi.abb"'

    def user(self, header: str, method: str, target: str) -> str | None:
        """Return the user of a header; None if not admitted; see `dialect.Users`."""
        del method, target
        scheme, _, rest = header.partition(" ")
        try:
            name, _, given = b64decode(rest.strip(), validate=True).decode().partition(":")
        except (Error, UnicodeDecodeError, ValueError):
            return None
        password = self.users.get(name)
        # Compared even if there is no such user, so that the response time leaks nothing.
        right = hmac.compare_digest(given.encode(), (password or "").encode())
        return name if right and password is not None and scheme.lower() == "basic" else None
