"""Protection against requests of web pages through browsers on the same computer.

A page of another site can make a browser send requests to this server, and a name that resolves to
this computer (DNS rebinding) makes them look local. Both are revealed by the headers Host, Origin
and Sec-Fetch-Site, which a page cannot choose.
"""

from __future__ import annotations

from collections.abc import Mapping
from ipaddress import ip_address
from typing import Final

from rapidsim.values import value_class

_SCHEMES: Final = ("http", "https", "ws", "wss")


@value_class(frozen=True, slots=True)
class Guard:
    """Admits requests to localhost, the host, and numeric addresses, which cannot be rebound."""

    host: str
    """Host that the server listens on."""
    hosts: frozenset[str] = frozenset()
    """Further names of this server, in lower case."""
    origins: frozenset[str] = frozenset()
    """Origins of pages of others that may use it, in lower case."""

    def objection(self, method: str, path: str, headers: Mapping[str, str]) -> str | None:
        """Return why a request is refused: another server's name, or a page of another site.

        Such pages may only link to the operator page.
        """
        host = headers.get("Host", "").lower()
        name = _name(host)
        known = ("localhost", self.host.lower(), *self.hosts)
        if name not in known and not _is_address(name):
            return "this server has another name; `--allow-host NAME` gives it more"
        if self.allows(headers.get("Origin")):
            return None
        origin = headers.get("Origin")
        is_link = method == "GET" and path.rstrip("/") == "/ui"
        is_own = headers.get("Sec-Fetch-Site", "none") in ("none", "same-origin")
        if origin is None:
            is_admitted = is_link or is_own
        else:
            # Some clients that are no browsers name the websocket.
            is_admitted = origin.lower() in {f"{one}://{host}" for one in _SCHEMES}
        return (
            None if is_admitted else "pages of others are refused; `--allow-origin URL` admits one"
        )

    def allows(self, origin: str | None) -> bool:
        """Whether pages of another origin may use this server and read its answers."""
        return origin is not None and origin.lower() in self.origins


def is_loopback(host: str) -> bool:
    """Whether an address can be reached from this computer only."""
    return host == "localhost" or (_is_address(host) and ip_address(host).is_loopback)


def _is_address(host: str) -> bool:
    try:
        ip_address(host)
    except ValueError:
        return False
    return True


def _name(host: str) -> str:
    """Return the host of a header, without its port."""
    if host.startswith("["):
        return host.partition("]")[0].lstrip("[")
    return host.partition(":")[0]
