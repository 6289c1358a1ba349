"""Steps through loops: one stop for each evaluation of a condition, forwards and backwards."""

from __future__ import annotations

from pathlib import Path

import pytest
from dap_client import Client

from rapidsim.interpreter.tools.debugging import Debugger, Stop
from rapidsim.interpreter.tools.step_positions import StepGranularity
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import executed, loaded, prepared

LOOPS = {
    "a condition behind the body": (
        "WHILE n<2 DO\nn:=n+1;\nIF n=1 THEN\nn:=n;\nENDIF\nENDWHILE\n;",
        "1 2 3 4 1 2 3 1 7",
    ),
    "a condition on two lines": ("WHILE n<2 AND\nm=0 DO\nn:=n+1;\nENDWHILE\n;", "1 3 1 3 1 5"),
    "no turn": ("WHILE n>0 DO\nn:=n+1;\nENDWHILE\n;", "1 4"),
    "no body": (
        "WHILE n<3 DO\nn:=n+1;\nWHILE odd(m) DO\nENDWHILE\nENDWHILE",
        "1 2 3 1 2 3 1 2 3 1",
    ),
    "an error in the condition": (
        "WHILE 1/(n-1)<2 AND n<3 DO\nn:=n+1;\nENDWHILE\n;",
        "1 2 1 E 1 2 1 4",
    ),
    "a counter": ("FOR i FROM 1 TO 2 DO\nn:=n+i;\nENDFOR\n;", "1 2 1 2 1 4"),
    "a counter down": ("FOR i FROM 2 TO 1 STEP -1 DO\nn:=n+i;\nENDFOR\n;", "1 2 1 2 1 4"),
    "a line": ("FOR i FROM 1 TO 2 DO n:=n+1; ENDFOR\n;", "1 1 1 2"),
    "loops in loops": (
        "FOR i FROM 1 TO 2 DO\nm:=0;\nWHILE m<i DO\nm:=m+1;\nENDWHILE\nENDFOR",
        "1 2 3 4 3 1 2 3 4 3 4 3 1",
    ),
    "a jump": ("again:\nn:=n+1;\nIF n<3 GOTO again;", "2 3 2 3 2 3"),
}
_FIRST = 5
"""Line before the first one of a loop."""


def program(loop: str) -> str:
    return (
        "MODULE m\nFUNC bool odd(num k)\nRETURN k>0;\nENDFUNC\n"
        f"PROC main() VAR num n; VAR num m;\n{loop}\n"
        "ERROR\nn:=n+1;\nRETRY;\nENDPROC\nENDMODULE\n"
    )


@pytest.mark.parametrize("name", LOOPS)
def test_a_condition_is_stopped_at_once_an_evaluation(name: str, tmp_path: Path) -> None:
    loop, wanted = LOOPS[name]
    (tmp_path / "loop.mod").write_text(program(loop))
    clause = _FIRST + len(loop.splitlines()) + 1
    places: list[str] = []

    def stop(stop: Stop) -> None:
        line = stop.frame.f_lineno
        if line < clause and line > _FIRST:
            places.append(str(line - _FIRST))
        elif line == clause + 1:
            places.append("E")
        debugger.step(StepGranularity.ANY, stop.frame)

    debugger = Debugger(stop)
    debugger.pause()
    request = RunRequest(paths=(str(tmp_path / "loop.mod"),), home=str(tmp_path))
    debugger.run(lambda: executed(prepared(loaded(job(request)))))
    assert " ".join(places) == wanted


@pytest.mark.process
def test_a_loop_is_stepped_back_as_it_was_stepped_forwards(tmp_path: Path) -> None:
    loop = "WHILE n<3 DO\nn:=n+1;\nFOR i FROM 1 TO 2 DO\nm:=i;\nENDFOR\nENDWHILE\n;"
    (tmp_path / "loop.mod").write_text(program(loop))
    with Client(tmp_path) as client:
        client.launch("loop.mod", stopOnEntry=True)
        client.stopped()
        forwards = [(client.place(), client.scope("Routine"))]
        for _ in range(12):
            client.go("next")
            forwards.append((client.place(), client.scope("Routine")))
        backwards = [forwards[-1]]
        for _ in range(12):
            client.go("stepBack")
            backwards.append((client.place(), client.scope("Routine")))
        assert backwards == forwards[::-1]
        lines = "".join(str(place[1] - _FIRST) for (place, _) in forwards[1:])
        assert lines == "234343123434"
