"""Rules I8 that need no run: names of signals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class UnknownSignal(Violation):
    """A name is used as a signal, and neither a module nor the station declares it.

    A controller takes signals from its I/O configuration, which is not part of the program. A run
    creates the signal with the value 0 when it is first used; an input stays 0 unless something
    sets it.

    ## Example

        MODULE example
          PROC main()
            SetDO doGripper,1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR signaldo doGripper;
          PROC main()
            AliasIO "doGripper_1",doGripper;
            SetDO doGripper,1;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "I801"
    name: ClassVar[str] = "unknown-signal"
    template: ClassVar[str] = "the signal `{signal}` is not declared; a run creates it"
    severity: ClassVar[Severity] = Severity.WARNING

    signal: str
    type: str

    @property
    def help(self) -> str:
        """Where signals are declared."""
        return (
            f"the controller takes its {self.type} from the I/O configuration; a run starts it at 0"
        )
