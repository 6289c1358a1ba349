"""Protection against requests of web pages through browsers on the same computer.

A page of another site can make a browser send requests to this server, and a name that resolves to
this computer (DNS rebinding) makes them look local. Both are revealed by the headers Host, Origin
and Sec-Fetch-Site, which a page cannot choose.
"""

from __future__ import annotations

from collections.abc import Mapping
from ipaddress import ip_address

from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Guard:
    """Admits requests to localhost, the host, and numeric addresses, which cannot be rebound."""

    host: str
    """Host that the server listens on."""

    def admits(self, method: str, path: str, headers: Mapping[str, str]) -> bool:
        """Whether a request addresses this server and is not sent by a page of another site.

        Such pages may only link to the operator page.
        """
        host = headers.get("Host", "").lower()
        name = _name(host)
        if name not in ("localhost", self.host.lower()) and not _is_address(name):
            return False
        origin = headers.get("Origin")
        if origin is not None:
            return origin.lower() in (f"http://{host}", f"https://{host}")
        is_link = method == "GET" and path.rstrip("/") == "/ui"
        return is_link or headers.get("Sec-Fetch-Site", "none") in ("none", "same-origin")


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
