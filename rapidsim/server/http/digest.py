"""Digest authentication as controllers require it (RFC 7616 with MD5).

A nonce stays valid as long as the process lives and may be reused: a public client computes the
header of its websocket from the last one.
"""

from __future__ import annotations

import hashlib
import hmac
import re
import secrets
from collections.abc import Mapping
from dataclasses import field
from typing import Final

from rapidsim.values import value_class

REALM: Final = "validusers@robapi.abb"
_PARAMETER: Final = re.compile(r'(\w+)\s*=\s*(?:"((?:[^"\\]|\\.)*)"|([^\s,]+))')


@value_class(frozen=True, slots=True)
class DigestAuthentication:
    """Users that are admitted with Digest authentication."""

    users: Mapping[str, str]
    """Passwords by name."""
    _nonce: str = field(default_factory=lambda: secrets.token_hex(16))
    _opaque: str = field(default_factory=lambda: secrets.token_hex(16))

    @property
    def challenge(self) -> str:
        """Header that requests authentication from a client."""
        return (
            f'Digest realm="{REALM}", domain="/", qop="auth", nonce="{self._nonce}", '
            f'opaque="{self._opaque}", algorithm="MD5", stale="FALSE"'
        )

    def user(self, header: str, method: str, target: str) -> str | None:
        """Return the user of a header; None if not admitted.

        Args:
            header: `Authorization` of the request.
            method: Method of the request.
            target: Address of the request as it was sent, with the query.
        """
        scheme, _, rest = header.partition(" ")
        if scheme.lower() != "digest":
            return None
        found = {key: quoted or plain for key, quoted, plain in _PARAMETER.findall(rest)}
        name, password = found.get("username", ""), self.users.get(found.get("username", ""))
        if password is None or found.get("nonce") != self._nonce or found.get("uri") != target:
            return None
        first = _md5(f"{name}:{found.get('realm', '')}:{password}")
        second = _md5(f"{method}:{target}")
        middle = [self._nonce]
        if "qop" in found:
            middle += [found.get("nc", ""), found.get("cnonce", ""), found["qop"]]
        expected = _md5(":".join((first, *middle, second)))
        right = hmac.compare_digest(expected, found.get("response", ""))
        return name if right and found.get("realm") == REALM else None


def _md5(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()
