"""Random targets run with a quarter off, are warned of with two, and stop with another cfx."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
import pytest
from laws import cases
from simulation_program import arm, ran
from simulation_reach import checked

from rapidsim.frames.transform import Array
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.verdict import Level, run_verdict

NO_AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
MANY = range(cases(200))


def target(joints: Array, conf: list[int]) -> str:
    """A target at joints [rad] with a stored configuration."""
    pose = arm().forward(joints)
    position = ",".join(f"{value:.2f}" for value in 1e3 * pose.translation)
    rotation = ",".join(f"{value:.7f}" for value in pose.quaternion)
    return f"[[{position}],[{rotation}],{str(conf).replace(' ', '')},{NO_AXES}]"


def drawn(seed: int) -> tuple[random.Random, Array, list[int]]:
    """Joints away from singularities and borders, with their configuration."""
    draw = random.Random(seed)
    while True:
        share = np.array([draw.uniform(0.1, 0.9) for _ in range(6)])
        joints = arm().lower + share * (arm().upper - arm().lower)
        counted = joints[[0, 3, 5]] / (np.pi / 2.0)
        border = np.abs(counted - np.round(counted)).min()
        if border > 0.05 and np.linalg.svd(arm().kinematics.jacobian(joints))[1].min() > 0.03:
            return draw, joints, confdata_of(arm().kinematics, joints).tolist()


def program(joints: Array, there: str, move: str = "MoveJ") -> str:
    """Go to joints [rad], then to a target."""
    axes = ",".join(f"{value:.4f}" for value in np.degrees(joints))
    return f"""MODULE cell
  CONST robtarget p:={there};
  PROC main()
    MoveAbsJ [[{axes}],{NO_AXES}],v1000,fine,tool0;
    {move} p,v100,fine,tool0;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize("seed", MANY)
def test_one_quarter_off_runs_quietly_and_is_a_note_with_its_fix(seed: int) -> None:
    draw, joints, conf = drawn(seed)
    off = [draw.randint(-1, 1) for _ in range(3)]
    stored = [one + way for one, way in zip(conf, [*off, 0], strict=True)]
    start = joints + np.radians([3.0, -2.0, 2.0, 4.0, 3.0, -5.0]) * draw.choice((-1.0, 1.0))
    text = program(np.clip(start, arm().lower, arm().upper), target(joints, stored))
    it = ran(text)
    assert it.end == "ended"
    assert "K603" not in [code for code, _ in it.findings]
    assert run_verdict(it.run).level is Level.CLEAN
    assert np.abs(it.run.moves[1].joints - joints).max() < 0.01
    found = checked(text)
    assert not [one for one in found.findings if one.diagnostic.severity == "error"]
    noted = [one for one in found.findings if one.code == "K622"]
    assert len(noted) == any(off)
    if noted:
        fix = noted[0].diagnostic.fix
        assert fix is not None
        assert fix.edits[0].text == str(conf).replace(" ", "")
    exact = ran(text, exact_configuration=True)
    assert (exact.end == "error") is any(off)


@pytest.mark.parametrize("seed", MANY)
def test_two_quarters_off_goes_on_and_the_headline_says_so(seed: int) -> None:
    draw, joints, conf = drawn(seed)
    conf[draw.randrange(3)] += draw.choice((-2, 2))
    text = program(joints, target(joints, conf), draw.choice(("MoveJ", "MoveL")))
    it = ran(text)
    (found,) = [one for one in it.run.diagnostics if one.code in ("K603", "K606")]
    assert (it.end, found.severity) == ("ended", "warning")
    assert "1 target not in the stored configuration" in run_verdict(it.run).headline
    assert np.abs(it.run.moves[1].joints - joints).max() < 0.01
    by_value = checked(text, run=False).only(found.code)
    assert (by_value.severity, by_value.message) == ("warning", found.message)


@pytest.mark.parametrize("seed", MANY)
def test_another_branch_at_the_end_of_a_line_stops(seed: int) -> None:
    draw, joints, conf = drawn(seed)
    conf[3] ^= draw.randint(1, 7)
    text = program(joints, target(joints, conf), "MoveL")
    it = ran(text)
    assert it.end == "error"
    assert it.findings[-1][0] in ("K603", "K606")
    nearest = ran(text, nearest_configuration=True)
    assert nearest.end == "ended"
    assert run_verdict(replace(nearest.run, strict=True)).failure is not None
    options = RunOptions(exact_configuration=True)
    assert [one.code for one in checked(text, options=options).findings if "K60" in one.code]
