"""The Python API does what the command line does."""

from pathlib import Path

import numpy as np
import pytest
from cli_helper import PROGRAMS

import rapidsim
from rapidsim.files import InputError
from rapidsim.jobs.running.run_files import ProgramRejectedError


def test_check_finds_what_the_command_finds() -> None:
    result = rapidsim.check([PROGRAMS / "wrong.mod"])
    assert not result.accepted
    assert {"N201", "E103", "N209"} <= {d.violation.code for d in result.diagnostics}
    clean = rapidsim.check([PROGRAMS / "cell.mod"], robot="irb1600")
    assert clean.accepted
    assert (clean.coverage.by_value, clean.coverage.unchecked) == (5, ())
    small = rapidsim.check([PROGRAMS / "cell.mod"], robot="irb120")
    assert {d.violation.code for d in small.diagnostics if d.severity == "error"} == {"K601"}
    by_default = rapidsim.check([PROGRAMS / "cell.mod"])
    assert by_default.coverage.unchecked == ()


def test_simulate_and_record(tmp_path: Path) -> None:
    run = rapidsim.simulate([PROGRAMS / "cell.mod"], robot="irb1600", max_time=60.0)
    assert run.end == "ended"
    assert len(run.moves) == 5
    samples = run.trajectory.at(np.array([0.0, 0.5, 1.0]) * run.trajectory.duration)
    assert samples.joints.shape == (3, 6)
    assert run.trajectory.times[-1] == run.trajectory.duration
    assert run.trajectory.joints.shape == (len(run.trajectory.times), 6)
    assert np.array_equal(run.trajectory.joints[-1], run.sample(run.trajectory.duration).joints[0])
    assert np.array_equal(run.sample(np.array([0.0, 1.0])).times, [0.0, 1.0])
    file = rapidsim.record(run, tmp_path / "cell.rrd")
    assert file.stat().st_size > 0


def test_robots_answer_in_radians_and_metres() -> None:
    robot = rapidsim.load_robot("irb120")
    pose = robot.forward(np.zeros(6))
    assert pose.translation == pytest.approx([0.374, 0.0, 0.63], abs=1e-9)


def test_a_run_has_its_persistents(tmp_path: Path) -> None:
    file = tmp_path / "count.mod"
    file.write_text("MODULE a\n PERS num n:=1;\n PROC main()\n  n:=n+1;\n ENDPROC\nENDMODULE\n")
    run = rapidsim.simulate([file], robot="irb1600")
    assert [(one.name, one.old, one.new) for one in run.persistents] == [("n", "1", "2")]
    assert "n:=1;" in file.read_text()


def test_mistakes_are_exceptions_that_say_what() -> None:
    with pytest.raises(ProgramRejectedError) as rejected:
        rapidsim.simulate([PROGRAMS / "wrong.mod"], robot="irb1600")
    assert rejected.value.diagnostics
    with pytest.raises(InputError, match="does not exist"):
        rapidsim.check(["nowhere.mod"])
