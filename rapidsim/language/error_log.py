"""Entries of the controller's event log, for IError and ReadErrData.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "errdomain",
"errtype", "ErrWrite", "ErrLog". Numbers are without the digits of their domain, as in
ReadErrData: 80001 is number 1 of domain 8.
"""

from __future__ import annotations

from rapidsim.values import value_class

ANY = 0.0
"""COMMON_ERR as a domain, TYPE_ALL as a type."""
MOTION_DOMAIN, USER_DOMAIN, PROCESS_DOMAIN = 5.0, 8.0, 11.0
STATE, WARNING, ERROR = 1.0, 2.0, 3.0
"""Types of entries."""


@value_class(frozen=True, slots=True)
class LoggedError:
    """One entry."""

    domain: float
    number: float
    type: float
    title: str = ""
    texts: tuple[str, ...] = ()
    """At most five."""

    def is_meant_by(self, domain: float, number: float | None, type_: float) -> bool:
        """Whether an order for a domain, a number in it, and a type matches this entry."""
        return (
            domain in {ANY, self.domain}
            and number in {None, self.number}
            and type_ in {ANY, self.type}
        )


CORNER_PATH_FAILURE = LoggedError(MOTION_DOMAIN, 24.0, WARNING, "Corner path failure")
"""Source: Operating manual Trouble shooting, event 50024."""
