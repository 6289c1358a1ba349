"""The program with a plate that one robot turns: the other one stays on the edge of the plate."""

from pathlib import Path

import numpy as np

import rapidsim
from rapidsim.diagnostics import Severity

PROGRAM = Path(__file__).parents[2] / "programs" / "coordinated" / "Holder.mod"
CORNERS = ((-100, -100), (100, -100), (100, 100), (-100, 100), (-100, -100))


def test_the_torch_runs_along_a_square_on_the_plate_that_turns() -> None:
    run = rapidsim.simulate([PROGRAM])
    assert run.end == "ended"
    assert run.diagnostics == ()
    holder, worker = run.robots
    together = [move for move in worker.moves if move.move.sync_id is not None]
    times = np.linspace(together[0].start_s, together[-1].end_s, 300)
    flange = holder.robot.forward(holder.trajectory.at(times).joints)
    plate = holder.world_from_base @ flange
    torch = worker.world_from_base @ worker.trajectory.at(times).base_from_tcp
    x, y, z = 1e3 * (plate.inverse() @ torch).translation.T
    # 5 mm in front of the plate, which is 50 mm thick.
    assert np.abs(z - 55.0).max() < 0.05
    off_edge = np.abs(np.maximum(np.abs(x), np.abs(y)) - 100.0)
    in_corners = np.minimum(np.abs(x), np.abs(y)) > 85.0
    assert off_edge[~in_corners].max() < 0.05
    assert off_edge.max() < 5.0
    for move, (end_x, end_y) in zip(together, CORNERS[1:], strict=True):
        near = np.abs(times - move.end_s).argmin()
        assert np.hypot(x[near] - end_x, y[near] - end_y) < 6.0
    turned = holder.trajectory.at(times).joints
    assert np.ptp(turned, axis=0).max() > np.radians(25.0)


def test_a_check_runs_both_tasks_and_finds_nothing_wrong() -> None:
    found = rapidsim.check([PROGRAM]).diagnostics
    assert {one.severity for one in found} == {Severity.NOTE}
