"""Rules F about error numbers in programs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class RawErrorNumber(Violation):
    """ERRNO is compared with a number instead of a name.

    The names of errors are documented, their numbers are not. In a run errors have numbers of their
    own, so that the comparison never holds. Numbers from 1 to 90 are free for programs; others of
    its own a program books with BookErrNo.

    ## Example

        MODULE example
          VAR num parts;
          PROC main()
            parts:=100/parts;
          ERROR IF ERRNO=1074 TRYNEXT;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR num parts;
          PROC main()
            parts:=100/parts;
          ERROR IF ERRNO=ERR_DIVZERO TRYNEXT;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "F414"
    name: ClassVar[str] = "raw-error-number"
    template: ClassVar[str] = "ERRNO is compared with {number}: no error of a run has that number"
    severity: ClassVar[Severity] = Severity.WARNING

    number: str

    @property
    def help(self) -> str:
        """What to compare with."""
        return "compare with the ERR_ name, or book a number with BookErrNo"
