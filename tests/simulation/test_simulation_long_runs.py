"""Runs of very many moves are looked at more coarsely, and what is shown of them stays true."""

from __future__ import annotations

import numpy as np
import pytest

from rapidsim.jobs.running.run_files import simulate
from rapidsim.recording import samples as recorded
from rapidsim.report.run import figures as of_run
from rapidsim.simulation.results import sampling
from rapidsim.simulation.results.simulation import Simulation

PROGRAM = """MODULE zigzag
  CONST robtarget a:=[[800,-200,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfL\\Off;
    ConfJ\\Off;
    MoveJ a,v1000,fine,tool0;
    FOR n FROM 1 TO 20 DO
      MoveL Offs(a,5*n,20*(n MOD 2),0),v200,z1,tool0;
    ENDFOR
    MoveL a,v200,fine,tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    file = tmp_path_factory.mktemp("zigzag") / "zigzag.mod"
    file.write_text(PROGRAM)
    return simulate([file], robot="irb1600")


def test_what_is_looked_at_coarsely_is_what_is_there(
    run: Simulation, monkeypatch: pytest.MonkeyPatch
) -> None:
    exact = sampling.sampled(run, run.only, 0.012)
    monkeypatch.setattr(sampling, "MOST_EXACT", 0)
    coarse = sampling.sampled(run, run.only, 0.012)
    assert np.array_equal(exact.samples.times, coarse.samples.times)
    assert not np.array_equal(exact.samples.joints, coarse.samples.joints)
    assert coarse.samples.joints == pytest.approx(exact.samples.joints, abs=1e-6)
    off = exact.samples.base_from_tcp.translation - coarse.samples.base_from_tcp.translation
    assert np.abs(off).max() < 5e-6


def test_figures_need_no_ends_of_moves(run: Simulation, monkeypatch: pytest.MonkeyPatch) -> None:
    exact = of_run.figures(run)
    monkeypatch.setattr(of_run, "MOST_EXACT", 0)
    monkeypatch.setattr(of_run, "_MOST_SAMPLES", 2)
    assert len(of_run._sample_times(run.only, run.only.trajectory.duration)) == 2
    monkeypatch.undo()
    monkeypatch.setattr(of_run, "MOST_EXACT", 0)
    coarse = of_run.figures(run)
    assert _margins(coarse) == pytest.approx(_margins(exact), abs=1e-4)
    assert coarse.moves_by_instruction == exact.moves_by_instruction


def _margins(figures: of_run.Figures) -> tuple[float, float]:
    assert figures.joint_margin is not None
    assert figures.singularity is not None
    return figures.joint_margin.degrees, figures.singularity.smallest_singular_value


def test_the_samples_of_a_recording_are_no_more_than_its_time_asks_for(
    run: Simulation, monkeypatch: pytest.MonkeyPatch
) -> None:
    (with_edges,) = recorded.sample(run, None)
    monkeypatch.setattr(recorded, "_MOST_EDGED", 5)
    (without,) = recorded.sample(run, None)
    assert len(without.samples.times) <= run.motion_end_s / without.dt + 2
    assert len(with_edges.samples.times) > len(without.samples.times)
