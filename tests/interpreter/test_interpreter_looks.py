"""What a debugger sees and sets where a program stands, without the tracing of a debugger.

The program looks where it writes a text: the controller that receives it has the frames.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType

from interpreter_cell import RecordingController, checked
from whole_findings import assert_section

from rapidsim.analysis.program import Storage
from rapidsim.interpreter.linking.loader import load
from rapidsim.interpreter.linking.symbols import TaskSymbols
from rapidsim.interpreter.tools.assignments import assign
from rapidsim.interpreter.tools.expression_queries import QueryError, answers, check_query
from rapidsim.interpreter.tools.frame_expressions import FrameExpressions
from rapidsim.interpreter.tools.inspection import (
    NotShownError,
    is_data_path,
    local_names,
    module_names,
    parameters,
    parts_of,
    place_of,
    rapid_text,
)
from rapidsim.interpreter.tools.step_positions import FramePositions, rapid_frames
from rapidsim.language.controller import uniform_controller

LOOKS = Path(__file__).parent / "golden" / "looks.txt"
TEXT = """MODULE cell
  RECORD part
    num width;
    pose place;
  ENDRECORD
  CONST num limit:=3;
  PERS num kept:=1;
  LOCAL VAR num hidden:=4;
  VAR num list{2,3}:=[[1,2,3],[4,5,6]];
  VAR part one:=[7,[[1,2,3],[1,0,0,0]]];
  VAR bool flag:=TRUE;
  VAR string text:="a";
  VAR dnum large:=16777217;
  VAR clock watch;
  VAR num x:=0.5;
  VAR num other_only:=9;
  PROC main()
    VAR num own:=2;
    VAR num later;
    VAR num row{2}:=[8,9];
    CONST num own_limit:=5;
    TPWrite "main";
    FOR x FROM 1 TO 2 DO
      TPWrite "loop";
      FOR row FROM 5 TO 5 DO
        TPWrite "inner";
      ENDFOR
    ENDFOR
    go own,row,one.place,3\\given:=4;
    TPWrite "after";
    fails;
    own:=twice(own);
  ENDPROC
  PROC go(INOUT num a,num b{*},INOUT pose c,num d\\num given|num absent\\switch on)
    VAR num count;
    WHILE count<1 DO
      Incr count;
      TPWrite "go";
    ENDWHILE
    take list{2,1},c.trans.x;
  ENDPROC
  PROC take(INOUT num e,INOUT num f)
    TPWrite "take";
    f:=f+1;
  ENDPROC
  PROC fails()
    VAR num local_in:=1;
    local_in:=1/(x-x);
  ERROR
    TPWrite "clause";
    TRYNEXT;
  ENDPROC
  FUNC num twice(num v)
    TPWrite "twice";
    RETURN 2*v;
  ENDFUNC
ENDMODULE
"""
OTHER = """MODULE other
  LOCAL VAR num hidden:=6;
  VAR num shown:=hidden0;
  CONST num hidden0:=6;
ENDMODULE
"""
PATHS = (
    *(
        "own",
        "OWN",
        "later",
        "row",
        "row{2}",
        "row{own}",
        "row{3}",
        "row{0}",
        "row{x}",
        "own_limit",
    ),
    *("limit", "kept", "hidden", "list", "list{2,3}", "list{2}{3}", "list{2}", "one", "one.width"),
    *("one.place.trans.y", "one.place.trans.w", "one.width.x", "one{1}", "list.x", "flag", "text"),
    *("large", "watch", "x", "other_only", "shown", "nowhere", "tool0.mass", "tool0.tload.mass"),
    *("v100.v_tcp", "a", "b", "b{1}", "c", "c.trans.x", "d", "given", "absent", "on", "count", "e"),
    *("f", "local_in", "v", "1x", "own+1", "row{flag}", "reg1", "row{ own }", "one . width"),
)
EXPRESSIONS = (
    *("own+1", "x>0 AND flag", "list{2,x}=4", "NOT flag", "text+text", "one.place.trans*2", "d*a"),
    *("twice(2)", "own:=2", "own own", "nowhere+1", "own+text", "di1", "di1=1", "watch", "1/0"),
    *("b{2}+given", "absent+1", "", "RETURN 1", "shown+hidden", "[1,2,3]", "row", "large+1"),
)
VALUES = (
    *(("own", "5"), ("own", "5.5"), ("own", "text"), ("limit", "4"), ("own_limit", "4")),
    *(("x", "3"), ("row{2}", "7"), ("row", "[3,4]"), ("row", "[3]"), ("list{1,2}", "20")),
    *(("one.place.trans.z", "30"), ("one", "[8,[[1,2,3],[1,0,0,0]]]"), ("flag", "FALSE")),
    *(("text", '"b"'), ("text", "b"), ("kept", "12"), ("a", "11"), ("b{1}", "12"), ("count", "1")),
    *(
        ("c.trans.x", "13"),
        ("d", "14"),
        ("given", "15"),
        ("absent", "16"),
        ("e", "17"),
        ("f", "18"),
    ),
    *(("hidden", "19"), ("shown", "20"), ("reg1", "21"), ("nowhere", "22"), ("local_in", "23")),
    *(("v", "24"), ("count", "0.5"), ("watch", "1")),
)


@dataclass
class Looking(RecordingController):
    """Notes what is seen at each text; may set a value at one."""

    look: Callable[[str, FrameType], Iterator[str]] = lambda text, frame: iter(())
    seen: list[str] = field(default_factory=list)

    def show(self, text: str) -> None:
        super().show(text)
        frame = next(rapid_frames(sys._getframe(1)))
        self.seen += self.look(text, frame)


def told(ask: Callable[[], object]) -> str:
    """An answer, or why there is none."""
    try:
        return f"{ask()}"
    except NotShownError as error:
        return f"({type(error).__name__.removesuffix('Error')}) {error}"


class Changes:
    """Lines that are not as they were the last time."""

    def __init__(self) -> None:
        self._before: dict[str, str] = {}

    def line(self, name: str, text: str) -> Iterator[str]:
        if self._before.get(name) != text:
            yield f"  {name}: {text}"
        self._before[name] = text


def looked(look: Callable[[str, FrameType], Iterator[str]]) -> str:
    controller = Looking(look=look)
    load(checked(TEXT, OTHER), uniform_controller(controller)).run()
    return "".join(f"{line}\n" for line in controller.seen)


def test_what_is_seen_of_data_at_each_place() -> None:
    positions, expressions = FramePositions(), FrameExpressions(lambda name: 1.0)
    changes = Changes()

    def look(text: str, frame: FrameType) -> Iterator[str]:
        at = positions.of(frame)
        yield f"{text}: {place_of(frame)}, line {positions.line(frame)}, depth {at.depth}"
        yield f"  parameters {' '.join(parameters(frame))}; locals {' '.join(local_names(frame))}"
        yield from changes.line("its module", " ".join(module_names(frame)))
        yield from changes.line("persistents", " ".join(module_names(frame, Storage.PERS)))
        for path in PATHS:
            value = told(lambda: f"{rapid_text(path, frame)} at {parts_of(path, frame)[1]}")  # noqa: B023
            yield from changes.line(path, f"{is_data_path(path)}, {value}")
        for one in EXPRESSIONS:
            value = told(lambda: expressions.checked(one, frame).value(frame).text)  # noqa: B023
            condition = told(lambda: expressions.condition(one, frame).type.name)  # noqa: B023
            yield from changes.line(f"? {one}", f"{value}; {condition}")

    assert_section(LOOKS, "data at each place", looked(look))


def test_what_can_be_set_at_each_place() -> None:
    seen = []
    for number, (path, value) in enumerate(VALUES):
        controller = Looking()
        task = load(checked(TEXT, OTHER), uniform_controller(controller))
        symbols, changes = TaskSymbols(task._linked), Changes()

        def look(text: str, frame: FrameType) -> Iterator[str]:
            before = told(lambda: rapid_text(path, frame))  # noqa: B023
            done = told(lambda: assign(path, value, frame, symbols))  # noqa: B023
            after = told(lambda: rapid_text(path, frame))  # noqa: B023
            answer = f"{before} -> {done}, {after}" if before != done else before
            yield from (f"  {text}{line[2:]}" for line in changes.line("", answer))  # noqa: B023

        controller.look = look
        task.run()
        seen += [f"{number} {path}:={value}", *controller.seen]
    assert_section(LOOKS, "setting data", "".join(f"{line}\n" for line in seen))


QUESTIONS = (
    *("kept=1", "kept=2", "hidden=4", "shown=6", "list{2,3}=6 AND flag", "list{3,1}=1", "flag"),
    *("kept", "kept=", "kept=1;", "kept=1; ENDFUNC", "nowhere=1", "one.place.trans.x=2", "large>1"),
    *("twice(2)=4", "quiet(kept)=2", "Sin(90)=1", "ClkRead(watch)=0", "DOutput(do1)=0", "do1=0"),
    *("tasks=2", "time_s>1", "TRUE", "kept=1 ! said", 'text="a"', "%text%=1"),
    *("1/(kept-1)=2", "UIMessageBox(text)=1", "limit=3 OR 1/0=1"),
)


def test_what_can_be_asked_of_a_program_after_its_run() -> None:
    text = TEXT.replace("ENDMODULE", "FUNC num quiet(num v)\nRETURN 2*v;\nENDFUNC\nENDMODULE")
    program = checked(text, OTHER)
    figures = {"time_s": 2.0, "kept": 7.0, "tasks": 2.0}
    task = load(program, uniform_controller(RecordingController()))
    task.run()
    asked, seen = [], []
    for one in QUESTIONS:
        try:
            found = check_query(one, "asked", program, figures)
        except QueryError as error:
            seen.append(f"{one}: refused: {error}")
            continue
        seen.append(f"{one}: {found.question and found.question.is_of_task}")
        for finding in found.findings:
            span = finding.span
            assert span is not None
            seen.append(f"  {finding.code} {span.start}-{span.end} {finding.message}")
        if found.question is not None:
            asked.append(found.question)
    for question, answer in zip(asked, answers(task, asked, figures), strict=True):
        values = ", ".join(f"{name} is {value}" for name, value in answer.values)
        seen.append(f"{question.text} = {answer.holds}; {values}; {answer.error or ''}")
    assert_section(LOOKS, "questions", "".join(f"{line}\n" for line in seen))
