"""One verdict for the terminal, the page, JSON, Python and the exit code."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import pytest
from report_run import run

from rapidsim.api.run import Run
from rapidsim.report.html.sections import head
from rapidsim.report.run.figures import figures
from rapidsim.report.run.json_report import RunFiles, run_json
from rapidsim.simulation.results.simulation import End
from rapidsim.simulation.results.verdict import Failure, Level, run_verdict

VERDICTS = {
    End.ENDED: (None, Level.CLEAN, "ended as programmed"),
    End.STOPPED: (None, Level.CLEAN, "stopped by the program"),
    End.CYCLE_LIMIT: (None, Level.CLEAN, "ended after the requested cycles"),
    End.TIME_LIMIT: (Failure.LIMIT, Level.QUALIFIED, "cut off"),
    End.ERROR: (Failure.PROGRAM, Level.FAILED, "stopped with an error"),
}


@pytest.mark.parametrize("end", list(End))
def test_all_outputs_share_the_verdict(end: End) -> None:
    simulation = replace(run(), end=end, unsimulated=())
    verdict = run_verdict(simulation)
    failure, level, words = VERDICTS[end]
    assert (verdict.failure, verdict.level) == (failure, level)
    assert verdict.headline == f"{words} after 2.500 s"
    report = run_json(simulation, figures(simulation), (), RunFiles())
    assert report["ok"] is verdict.ok is Run(simulation, ()).ok is (failure is None)
    assert verdict.headline in head(simulation)


@pytest.mark.parametrize("end", list(End))
@pytest.mark.parametrize("hits", [1, 2])
def test_a_collision_fails_whatever_the_end(end: End, hits: int) -> None:
    collisions = cast(Any, SimpleNamespace(crashes=(None,) * hits, part_errors=()))
    verdict = run_verdict(replace(run(), end=end, unsimulated=(), collisions=collisions))
    assert (verdict.ok, verdict.level) == (False, Level.FAILED)
    assert verdict.headline.endswith(f", with {hits} collision{'s' * (hits > 1)}")
    assert verdict.failure is (Failure.LIMIT if end is End.TIME_LIMIT else Failure.PROGRAM)


@pytest.mark.parametrize("end", list(End))
def test_assertions_fail_only_what_has_succeeded(end: End) -> None:
    simulation = replace(run(), end=end, unsimulated=())
    verdict = run_verdict(simulation, assertions_fail=True)
    failure = VERDICTS[end][0]
    assert verdict.failure is (failure or Failure.ASSERTION)
    assert not verdict.ok
