"""What a controller did with one corner between two lines: durations, and the speed in the corner.

An IRB 6640-180/2.55 on ABB's virtual controller, with a tool of 0.7 m from the wrist and no load.
The programs are written anew from their geometry; the figures are of its logs. Duration: from 5 mm
after the start to 5 mm before the end. Speed: of the TCP over 32 ms around the corner. Logs show
axes 1 and 2 on the motor side of an elastic drive, so both are taken there.

Source of the logs: public, hehonglu123/ABB_Primitive_Study @ 9215d88.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from rapidsim.files import SourceFile
from rapidsim.frames.transform import Array
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

TOOL = "[TRUE,[[75,0,493.30127],[0.9659258,0,0.2588190,0]],[1,[0,0,0.001],[1,0,0,0],0,0,0]]"
SPEEDS = {
    "v50": "[50,500,5000,1000]",
    "v300": "[300,500,5000,1000]",
    "v1000": "[1000,500,5000,1000]",
    "vmax": "[10000,9999999,9999999,999999]",
}
NEAR_M = 5e-3
STEP_S = 4e-3
ELASTIC_S2 = np.array([[2.5e-4, -0.9e-4, -0.5e-4], [0.2e-4, 3.3e-4, 1.0e-4]])
"""Motor angle less link angle of axes 1 and 2 for each unit of acceleration of axes 1 to 3."""
PERCENT, OF_SPEED = 1.7, 0.145
"""How far durations may be off, and the speed in the corner as a share of the controller's."""


@dataclass(frozen=True)
class Corner:
    """Start [deg], corner and end as in robtargets."""

    start: tuple[float, ...]
    corner: str
    end: str


OUTWARDS = Corner(
    (17.8816, 15.8645, 23.0564, 38.2544, -28.6215, -29.9142),
    "[[2200.1,-0.173,1000],[0.5555702,0,0.8314696,0]",
    "[[2450,-433.013,1000],[0.7071068,0,0.7071068,0]",
)
ASIDE = Corner(
    (35.9151, 48.1278, -14.08, 97.4483, -51.5278, 44.0335),
    "[[2296.153,692.087,669.367],[0.4137847,0.6422788,0.4545444,0.4578751]",
    "[[2428.903,309.071,594.903],[0.5281843,0.6120356,0.4721687,0.3514120]",
)
TURNING = Corner(
    OUTWARDS.start,
    "[[2200,-0.2,1000],[0.5555702,0,0.8314696,0]",
    "[[2200,-500,1000],[0.6853745,-0.0541932,0.7216278,-0.0811058]",
)
"""Straight on, with turns of 22.5 deg about axes 30 deg apart."""

CASES = (
    (OUTWARDS, "v300", "fine", 3.4634, None),
    (OUTWARDS, "v300", "z1", 3.3408, 281.2),
    (OUTWARDS, "v300", "z50", 3.3251, 298.4),
    (OUTWARDS, "v1000", "fine", 1.2808, None),
    (OUTWARDS, "v1000", "z1", 1.1468, 491.6),
    (OUTWARDS, "v1000", "z10", 1.1115, 747.1),
    (OUTWARDS, "v1000", "z50", 1.0789, 976.8),
    (OUTWARDS, "vmax", "fine", 0.9912, None),
    (OUTWARDS, "vmax", "z1", 0.8555, 492.5),
    (OUTWARDS, "vmax", "z10", 0.8148, 751.7),
    (OUTWARDS, "vmax", "z50", 0.7592, 1193.9),
    (ASIDE, "v300", "z10", 2.7413, 295.0),
    (ASIDE, "v1000", "fine", 1.0604, None),
    (ASIDE, "v1000", "z10", 0.9213, 687.0),
    (ASIDE, "vmax", "z10", 0.6375, 711.9),
)
"""Corner, speed, zone; duration [s]; speed at the corner [mm/s]."""


def figures_of(
    corner: Corner, speed: str, zone: str, model: MotionModel | None = None
) -> tuple[float, float]:
    """Duration [s] and speed at the corner [mm/s]."""
    rest = "[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    text = f"""MODULE corner
  PERS tooldata tLong:={TOOL};
  CONST robtarget pCorner:={corner.corner},{rest};
  CONST robtarget pEnd:={corner.end},{rest};
  PROC main()
    ConfL\\Off;
    MoveL pCorner,{SPEEDS[speed]},{zone},tLong;
    MoveL pEnd,{SPEEDS[speed]},fine,tLong;
  ENDPROC
ENDMODULE
"""
    program = load([SourceFile("corner.mod", text, "utf-8")]).program
    assert program is not None
    options = RunOptions(model=model or MotionModel(), start_joints_deg=corner.start)
    run = simulate(program, load_robot("irb6640-180-2.55"), options=options)
    trajectory = run.only.trajectory
    times = np.arange(0.0, trajectory.duration + 0.1, STEP_S)
    joints = trajectory.at(times).joints
    joints[1:-1, :2] += np.diff(joints[:, :3], 2, axis=0) / STEP_S**2 @ ELASTIC_S2.T
    tool = run.moves[0].tcp_from_flange.inverse()
    tcp = (run.only.robot.forward(joints) @ tool).translation
    away, left = (np.linalg.norm(tcp - point, axis=1) for point in (tcp[0], tcp[-1]))
    duration = _passes(left[::-1], times[::-1]) - _passes(away, times)
    via = run.moves[0].base_from_tcp.translation
    at = int(np.linalg.norm(tcp - via, axis=1).argmin())
    half = round(0.016 / STEP_S)
    speed_m_s = np.linalg.norm(tcp[at + half] - tcp[at - half]) / (2 * half * STEP_S)
    return duration, 1e3 * float(speed_m_s)


def _passes(distance: Array, times: Array) -> float:
    """When a distance, that grows from 0, is passed."""
    k = int(np.flatnonzero(distance > NEAR_M)[0])
    return float(np.interp(NEAR_M, distance[k - 1 : k + 1], times[k - 1 : k + 1]))


@pytest.mark.parametrize(("corner", "speed", "zone", "seconds", "mm_s"), CASES)
def test_a_corner_takes_as_long_as_on_the_controller(
    corner: Corner, speed: str, zone: str, seconds: float, mm_s: float | None
) -> None:
    duration, in_corner = figures_of(corner, speed, zone)
    assert 100.0 * (duration / seconds - 1.0) == pytest.approx(0.0, abs=PERCENT)
    if mm_s is not None:
        assert in_corner == pytest.approx(mm_s, rel=OF_SPEED)


@pytest.mark.parametrize(
    ("speed", "seconds", "mm_s"), [("v1000", 1.1009, 791.9), ("vmax", 0.7685, 821.7)]
)
def test_a_turn_of_the_tool_alone_slows_a_narrow_zone_as_on_the_controller(
    speed: str, seconds: float, mm_s: float
) -> None:
    """The wrist uses more of what it has there than main axes do."""
    duration, in_corner = figures_of(TURNING, speed, "z1")
    assert 100.0 * (duration / seconds - 1.0) == pytest.approx(0.0, abs=2.5)
    assert in_corner == pytest.approx(mm_s, rel=0.06)


def test_a_slow_stop_costs_less_than_a_quick_one() -> None:
    """A dwell of 102 ms from v300 on, of some 60 ms at v50: against the same corner with z10."""
    slow, quick = (
        figures_of(OUTWARDS, speed, "fine")[0] - figures_of(OUTWARDS, speed, "z10")[0]
        for speed in ("v50", "v300")
    )
    assert slow == pytest.approx(0.070, abs=0.015)
    assert quick == pytest.approx(0.133, abs=0.015)
