"""Findings that only a run can make (family R).

The examples of these pages are run, not only checked.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class UncaughtError(Violation):
    """An error reached the top of the call chain and no ERROR clause handled it.

    The controller logs the error and stops the program with the pointer at the statement; the call
    chain under the message leads there.

    ## Example

        MODULE example
          PROC main()
            VAR num parts:=0;
            VAR num each;
            each:=100/parts;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR num parts:=0;
            VAR num each;
            IF parts>0 THEN
              each:=100/parts;
            ENDIF
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R101"
    name: ClassVar[str] = "uncaught-error"
    template: ClassVar[str] = "{what}"

    what: str


@dataclass(frozen=True)
class QuestionUnanswered(Violation):
    """The program asked the operator, and nobody was there to answer.

    A default is taken so that the run goes on. Give answers in a file, one a line, with
    `--answers`; on a terminal the question is asked.

    ## Example

        MODULE example
          PROC main()
            VAR num count;
            TPReadNum count, "How many parts?";
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR num count:=3;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R102"
    name: ClassVar[str] = "question-unanswered"
    template: ClassVar[str] = "nobody answered `{prompt}`; {default} was taken"
    severity: ClassVar[Severity] = Severity.WARNING

    prompt: str
    default: str

    @property
    def help(self) -> str:
        """Where answers come from."""
        return "give answers with `--answers FILE`, one a line"


@dataclass(frozen=True)
class AnswerNotANumber(Violation):
    """The program asked the operator for a number and the answer is none.

    The answer comes from a file, so a default is taken and the run goes on; somebody at a terminal
    is asked again.
    """

    code: ClassVar[str] = "R103"
    name: ClassVar[str] = "answer-not-a-number"
    template: ClassVar[str] = (
        "the answer `{answer}` to `{prompt}` is no number; {default} was taken"
    )
    severity: ClassVar[Severity] = Severity.WARNING

    prompt: str
    answer: str
    default: str


@dataclass(frozen=True)
class AnswerNotAChoice(Violation):
    """The program asked the operator to press a key and the answer names none of them.

    The answer comes from a file, so the first key is taken and the run goes on; somebody at a
    terminal is asked again. Answer with the text on the key or its number.
    """

    code: ClassVar[str] = "R105"
    name: ClassVar[str] = "answer-not-a-choice"
    template: ClassVar[str] = (
        "the answer `{answer}` to `{prompt}` names no key; {default} was taken"
    )
    severity: ClassVar[Severity] = Severity.WARNING

    prompt: str
    answer: str
    default: str


@dataclass(frozen=True)
class EndlessWait(Violation):
    """The program waits for something that nothing can make happen.

    On the cell the program would hang here until somebody acts. In a run nobody does, unless the
    station file, or the file that `--io` names, says when inputs change: at a time, every so many
    seconds, or so long after an output has been set.

    ## Example

        MODULE example
          PROC main()
            Set doGrip;
            WaitDI diGripped,1;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            Set doGrip;
            WaitTime 0.4;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R106"
    name: ClassVar[str] = "endless-wait"
    template: ClassVar[str] = "{what}"

    what: str

    @property
    def help(self) -> str:
        """Where inputs get their values."""
        return "say when inputs change: [[stimulus]] in rapidsim.toml, or in a file for `--io`"


@dataclass(frozen=True)
class RoutineNotSimulated(Violation):
    """The program called a routine that rapidsim parses but does not simulate.

    What was done instead stands in the message; times and outputs after it may differ from the
    controller's.
    """

    code: ClassVar[str] = "R104"
    name: ClassVar[str] = "routine-not-simulated"
    template: ClassVar[str] = "`{routine}` is not simulated; instead: {treated_as}"
    severity: ClassVar[Severity] = Severity.WARNING

    routine: str
    treated_as: str


@dataclass(frozen=True)
class ProgramStopped(Violation):
    """The program stopped itself, and nobody starts it again.

    On the cell the program stands here until somebody presses start (Stop, Break) or moves the
    program pointer to main (EXIT). In a run nobody does, so the run ends.

    ## Example

        MODULE example
          PROC main()
            TPWrite "Change the gripper";
            Stop;
            TPWrite "Gripper changed";
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TPWrite "Change the gripper";
            TPWrite "Gripper changed";
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R107"
    name: ClassVar[str] = "program-stopped"
    template: ClassVar[str] = "`{instruction}` stopped the program here, and nobody starts it again"
    severity: ClassVar[Severity] = Severity.NOTE

    instruction: str


@dataclass(frozen=True)
class BackwardNotExecuted(Violation):
    """A routine has a BACKWARD clause, which a run never executes.

    The clause is for stepping backward by hand on the FlexPendant. A run goes forward only, so
    the clause is checked and otherwise left alone.

    ## Example

        MODULE example
          PROC main()
            TPWrite "Forward";
          BACKWARD
            TPWrite "Backward";
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TPWrite "Forward";
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R108"
    name: ClassVar[str] = "backward-not-executed"
    template: ClassVar[str] = "BACKWARD of `{routine}` is not executed: a run goes forward only"
    severity: ClassVar[Severity] = Severity.NOTE

    routine: str


@dataclass(frozen=True)
class CutOff(Violation):
    """The run reached its time limit, and the program was here.

    A cell that works until somebody stops it never ends by itself: `--max-time` says how much of it
    to see. `--cycles` counts runs of main, so it ends a loop without end only where ExitCycle does.
    A program that should have ended waits here, or goes round.

    ## Example

        MODULE example
          PROC main()
            WHILE TRUE DO
              WaitTime 1;
            ENDWHILE
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            FOR part FROM 1 TO 10 DO
              WaitTime 1;
            ENDFOR
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R109"
    name: ClassVar[str] = "time-limit"
    template: ClassVar[str] = "{what}"
    severity: ClassVar[Severity] = Severity.NOTE

    what: str


@dataclass(frozen=True)
class TrapStorms(Violation):
    """Interrupts come faster than their traps are done with, and the program never goes on.

    A controller stops when its queue of interrupts is full. Mostly a trap changes what raises it:
    the same signal, the same persistent.

    ## Example

        MODULE example
          VAR intnum changed;
          PROC main()
            CONNECT changed WITH again;
            ISignalDO doLamp,edge,changed;
            Set doLamp;
          ENDPROC
          TRAP again
            InvertDO doLamp;
          ENDTRAP
        ENDMODULE

    ## Fix

        MODULE example
          VAR intnum changed;
          PROC main()
            CONNECT changed WITH again;
            ISignalDO doLamp,edge,changed;
            Set doLamp;
          ENDPROC
          TRAP again
            InvertDO doOther;
          ENDTRAP
        ENDMODULE
    """

    code: ClassVar[str] = "R110"
    name: ClassVar[str] = "trap-storm"
    template: ClassVar[str] = "{what}"

    what: str


@dataclass(frozen=True)
class WorldZoneReached(Violation):
    r"""The robot came to a world zone that stops it (WZLimSup).

    The motion stops and the program cannot go on: on the cell somebody has to jog the robot out of
    the zone.

    ## Example

        MODULE example
          VAR shapedata table;
          VAR wztemporary guard;
          PROC main()
            WZBoxDef \Inside,table,[600,-500,0],[1500,500,800];
            WZLimSup \Temp,guard,table;
            MoveAbsJ [[0,40,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR shapedata table;
          VAR wztemporary guard;
          PROC main()
            WZBoxDef \Inside,table,[600,-500,0],[1500,500,800];
            WZLimSup \Temp,guard,table;
            MoveAbsJ [[0,-20,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R111"
    name: ClassVar[str] = "world-zone-reached"
    template: ClassVar[str] = "{what}"

    what: str
