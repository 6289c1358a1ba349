"""Laws of the debugger: it changes nothing, going back restores everything, nothing raises."""

from __future__ import annotations

import json
import random
import shutil
from pathlib import Path
from types import FrameType

import pytest
from dap_client import Client, RefusedError
from laws import cases

from rapidsim.interpreter.tools.debugging import Debugger, Stop
from rapidsim.interpreter.tools.step_positions import (
    FramePositions,
    StepGranularity,
    StepPosition,
)
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import LoadedJob, executed, loaded, prepared
from rapidsim.report.run.figures import figures
from rapidsim.report.run.json_report import RunFiles, run_json
from rapidsim.report.run.verdicts import Verdicts
from rapidsim.simulation.result_builder import FinishedRun

ROOT = Path(__file__).parents[2]
BOOK = sorted(
    path
    for path in (ROOT / "tests" / "rapid").glob("*/*.mod")
    if "PROC main()" in (text := path.read_text(encoding="utf-8", errors="replace"))
    and "! error" not in text
    and path.parent.name != "broken"
)
"""Programs of one file of the book of the language that are not rejected."""
SCOPES = ("Routine", "Module", "Persistents", "Signals", "Robot")

pytestmark = pytest.mark.process


def as_json(run: FinishedRun) -> str:
    simulation = run.simulation
    verdicts = Verdicts((), None)
    found = run_json(simulation, figures(simulation), simulation.diagnostics, RunFiles(), verdicts)
    return json.dumps(found)


def ready(program: Path, folder: Path) -> LoadedJob:
    """A program with an empty home folder."""
    home = folder / "home"
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir()
    return loaded(job(RunRequest(paths=(str(program),), home=str(home))))


@pytest.mark.parametrize("name", ["pentagon.mod", "cell", "two_robots", "coordinated"])
def test_a_run_is_the_same_with_a_debugger(name: str, tmp_path: Path) -> None:
    program = ROOT / "programs" / name
    alone = executed(prepared(ready(program, tmp_path)))
    steps, chance = [0], random.Random(name)

    def stop(stop: Stop) -> None:
        steps[0] += 1
        reach = StepGranularity.ANY if steps[0] < 3 else chance.choice([*StepGranularity])
        debugger.step(reach, stop.frame)

    debugger = Debugger(stop)
    debugger.pause()
    followed = debugger.run(lambda: executed(prepared(ready(program, tmp_path))))
    assert steps[0] > 1
    assert as_json(followed) == as_json(alone)


def test_a_deep_stack_is_not_counted_for_each_routine(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "deep.mod").write_text(
        """MODULE deep
  PROC main()
    down 300;
  ENDPROC
  PROC down(num n)
    IF n>0 down n-1;
  ENDPROC
ENDMODULE
"""
    )
    counted = []
    count = FramePositions.of

    def of(positions: FramePositions, frame: FrameType) -> StepPosition:
        counted.append(count(positions, frame))
        return counted[-1]

    monkeypatch.setattr(FramePositions, "of", of)
    debugger = Debugger(lambda stop: debugger.step(StepGranularity.CALLER, stop.frame))
    debugger.pause()
    debugger.run(lambda: executed(prepared(ready(tmp_path / "deep.mod", tmp_path))))
    assert debugger.number > 300
    assert len(counted) < 10


def state(client: Client) -> object:
    """All that can be seen at a stop."""
    frames = [(one["name"], one["line"]) for one in client.stack()]
    return frames, [client.scope(name) for name in SCOPES]


def test_a_step_and_a_step_back_restore_everything(tmp_path: Path) -> None:
    chance = random.Random(7)
    for number in range(cases(100)):
        program = chance.choice(BOOK)
        folder = tmp_path / str(number)
        folder.mkdir()
        shutil.copy(program, folder / program.name)
        with Client(folder) as client:
            client.launch(program.name, stopOnEntry=True)
            # Some programs have no statement, others end early.
            stops = client.stops()
            for _ in range(chance.randrange(12)):
                if stops:
                    client.request(chance.choice(["stepIn", "next"]))
                    stops = client.stops()
            if stops:
                before = state(client)
                client.request("stepIn")
                if client.stops():
                    client.go("stepBack")
                    assert state(client) == before, program


def test_random_requests_never_raise(tmp_path: Path) -> None:
    chance = random.Random(3)
    shutil.copytree(ROOT / "programs" / "cell", tmp_path / "cell")
    commands = [
        *("next", "stepIn", "stepOut", "stepBack", "reverseContinue", "continue", "pause"),
        *("restart", "threads", "stackTrace", "scopes", "variables", "evaluate", "setVariable"),
        *("setExpression", "dataBreakpointInfo", "exceptionInfo", "loadedSources", "runToTime"),
        *("restartFrame", "setDataBreakpoints", "setExceptionBreakpoints", "nonsense"),
    ]
    values: list[object] = [
        None,
        0,
        1,
        2,
        99,
        -1,
        "",
        "count",
        "1+",
        "nParts",
        "until 1",
        [],
        {},
        True,
        1e9,
    ]
    names = [
        *("threadId", "frameId", "variablesReference", "expression", "context", "name", "value"),
        *("time", "filters", "breakpoints", "startFrame", "levels"),
    ]
    for _ in range(cases(16)):
        with Client(tmp_path) as client:
            client.launch("cell", stopOnEntry=True)
            assert client.stops()
            for _ in range(60):
                chosen = chance.sample(names, 4)
                arguments = {name: chance.choice(values) for name in chosen}
                try:
                    client.request(chance.choice(commands), **arguments)
                except RefusedError:
                    continue
            texts = [one["body"]["output"] for one in client.events if one["event"] == "output"]
            assert not any("defect" in text for text in texts), texts
