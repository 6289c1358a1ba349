"""Rules I8 that need no run: names of signals."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import Severity, Violation

_NAMED = 4
"""Maximum number of signals in a message."""


class UnknownSignal(Violation, code="I801"):
    signal: str
    type: str
    other_text: tuple[UnknownSignal, ...] = ()
    """Findings that are reported together with it."""
    nearest: str | None = None
    """Signal of the cell with the nearest name."""
    is_closed: bool = False
    """Whether the cell declares its signals, so that a controller would have no other."""

    @property
    def severity(self) -> Severity:
        """Error if the cell declares its signals."""
        return Severity.ERROR if self.is_closed else Severity.WARNING

    @property
    def assumed_name(self) -> str:
        """The undeclared name."""
        return self.signal

    @property
    def is_reported_once(self) -> bool:
        """True: the help of all such findings is one block to paste."""
        return True

    def with_others(self, merged: Sequence[Violation]) -> UnknownSignal:
        """Merge all findings into one: they form one table of a station file."""
        new = {one.signal.lower(): one for one in merged if isinstance(one, UnknownSignal)}
        new.pop(self.signal.lower(), None)
        others_once = tuple(new.values())
        return UnknownSignal(self.signal, self.type, others_once, self.nearest, self.is_closed)

    @property
    def message(self) -> str:
        """One signal, or the first few of several by name."""
        runs = "" if self.is_closed else "; a run creates"
        if not self.other_text:
            return f"the signal `{self.signal}` is not declared{runs and f'{runs} it'}"
        names = [f"`{one.signal}`" for one in (self, *self.other_text)]
        if len(names) > _NAMED:
            names[_NAMED:] = [f"{len(names) - _NAMED} more"]
        *names, last = names
        return (
            f"the signals {', '.join(names)} and {last} are not declared{runs and f'{runs} them'}"
        )

    @property
    def help(self) -> str:
        """Suggested names, and the lines that declare the signals."""
        lines = (
            f'{one.signal} = {{ type = "{one.type.removeprefix("signal")}" }}'
            for one in (self, *self.other_text)
        )
        block = "\n".join(("[signals]", *lines))
        meant = [
            f"did you mean `{one.nearest}` by `{one.signal}`? Else "
            for one in (self, *self.other_text)
            if one.nearest
        ]
        paste = "paste this into `rapidsim.toml`, or let `rapidsim init` write it"
        return f"{''.join(meant[:1])}{paste}:\n{block}"
