"""What a program may not exceed to be turned into Python code, and the finding when it does."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import FrameType
from typing import ClassVar

from rapidsim.diagnostics import Diagnostic, Severity, Span, Violation

MAX_LOOPS = 15
"""Loops within loops; CPython allows 20 blocks, and error handling takes up to five."""
MAX_EXPRESSION = 200
"""Depth of an expression."""
MAX_BRANCHES = 1000
"""ELSEIF or CASE branches of one statement, which nest in Python."""
MAX_ELEMENTS = 10_000_000
"""Elements of all arrays that a program declares; a list takes eight bytes for each at least."""
RUNNING_DEPTH = 10_000
"""How deep Python calls may nest while a program runs; those of RAPID routines use no C stack."""
TRANSLATING_DEPTH = 10_000
"""And while it is translated: the parser bounds how deep programs nest, at several calls a level.
Never for `compile`, whose recursion does use the C stack."""


@contextmanager
def recursion_limit(limit: int) -> Iterator[None]:
    """Allow Python calls to nest so deep below this one, for a while.

    Counted from here, so that a program comes equally deep whoever runs it.
    """
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(_calls_so_far() + limit)
    try:
        yield
    finally:
        sys.setrecursionlimit(before)


def _calls_so_far() -> int:
    frame: FrameType | None = sys._getframe()
    calls = 0
    while frame is not None:
        frame = frame.f_back
        calls += 1
    return calls


@dataclass(frozen=True)
class NotExecutable(Violation):
    """A valid program goes beyond what the simulator can run.

    A controller may run it; the simulator says so instead of running something else.

    ## Example
    ```rapid
    MODULE deep
      PROC main()
        FOR a FROM 1 TO 2 DO FOR b FROM 1 TO 2 DO FOR c FROM 1 TO 2 DO FOR d FROM 1 TO 2 DO
        FOR e FROM 1 TO 2 DO FOR f FROM 1 TO 2 DO FOR g FROM 1 TO 2 DO FOR h FROM 1 TO 2 DO
        FOR i FROM 1 TO 2 DO FOR j FROM 1 TO 2 DO FOR k FROM 1 TO 2 DO FOR l FROM 1 TO 2 DO
        FOR m FROM 1 TO 2 DO FOR n FROM 1 TO 2 DO FOR o FROM 1 TO 2 DO FOR p FROM 1 TO 2 DO
          Incr reg1;
        ENDFOR ENDFOR ENDFOR ENDFOR ENDFOR ENDFOR ENDFOR ENDFOR
        ENDFOR ENDFOR ENDFOR ENDFOR ENDFOR ENDFOR ENDFOR ENDFOR
      ENDPROC
    ENDMODULE
    ```
    ## Fix
    ```rapid
    MODULE deep
      PROC main()
        FOR a FROM 1 TO 2 DO
          inner;
        ENDFOR
      ENDPROC
      PROC inner()
        FOR b FROM 1 TO 2 DO
          Incr reg1;
        ENDFOR
      ENDPROC
    ENDMODULE
    ```
    """

    code: ClassVar[str] = "E190"
    name: ClassVar[str] = "not-executable"
    template: ClassVar[str] = "{what} cannot be simulated"
    severity: ClassVar[Severity] = Severity.ERROR

    what: str


class NotExecutableError(Exception):
    """Raised by `load` instead of running a program wrongly."""

    def __init__(self, what: str, span: Span) -> None:
        """Say what cannot be run, in the words of the program, and where it stands."""
        self.diagnostic = Diagnostic(NotExecutable(what), span)
        super().__init__(f"{span.file}:{span.line}: {self.diagnostic.violation.message}")
