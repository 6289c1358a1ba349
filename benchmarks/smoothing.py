"""What smoothing of each axis by itself does to the path, and what ramps do to times.

    python benchmarks/smoothing.py

Prints the tables of `docs/timing.md`: how far the TCP is off a line and off a corner's point on an
IRB 1600, also with ramps of AccSet, and how much longer a move from stop point to stop point takes
with them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.model import MotionModel, Smoothing
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import RobotRun
from rapidsim.simulation.simulate import simulate

STEP_S = 0.0005
SPEEDS_MM_S = (100, 250, 500, 1000, 2000)
CORNER_MM_S = (250, 500, 1000)
START = "[[%g,0,%g],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
ARMS = {"irb1600-6-1.2": (650.0, 900.0), "irb6640-180-2.55": (1500.0, 1500.0)}


def main() -> None:
    """Print the tables."""
    small = load_robot("irb1600-6-1.2")
    print(f"{small.title}: mm off\n{'':>24}" + "".join(f"{f'v{v}':>9}" for v in SPEEDS_MM_S))
    line = [_off_a_line(small, v) for v in SPEEDS_MM_S]
    print(f"{'a line':>24}" + "".join(f"{one:9.3f}" for one in line))
    for smoothing in ("axes", "path"):
        for zone in (1, 10):
            off = [_off(small, _around_a_point(small, v, zone, smoothing)) for v in CORNER_MM_S]
            print(
                f"{f'point, z{zone}, {smoothing}':>24}{'':>9}"
                + "".join(f"{one:9.2f}" for one in off)
            )
    print(f"\n{small.title}, v1000: mm off a line, off a point with z10; s of both moves there")
    for ramp in (100, 50, 20, 10):
        set_ramp = f"AccSet 100, {ramp};"
        line_mm = _off_a_line(small, 1000, set_ramp)
        corner = _around_a_point(small, 1000, 10, "axes", set_ramp)
        point_mm, corner_s = _off(small, corner), corner.trajectory.duration
        print(f"{ramp:>6} %{line_mm:10.2f}{point_mm:10.2f}{corner_s:10.2f}")
    for name in ARMS:
        robot = load_robot(name)
        plain = _stop_to_stop(robot, 100)
        print(f"\n{robot.title}: a move between stop points with a ramp takes longer by [ms]")
        for ramp in (50, 10):
            print(f"{ramp:>6} %{1e3 * (_stop_to_stop(robot, ramp) - plain):10.0f}")


def _run(robot: Robot, moves: Sequence[str], smoothing: Smoothing = "axes") -> RobotRun:
    x, z = ARMS[robot.name]
    lines = "\n    ".join(moves)
    text = f"""MODULE m
  CONST robtarget p:={START % (x, z)};
  PROC main()
    ConfL \\Off;
    ConfJ \\Off;
    MoveJ p, v500, fine, tool0;
    {lines}
  ENDPROC
ENDMODULE
"""
    loaded = load([SourceFile("m.mod", text, "utf-8")])
    if loaded.program is None:
        raise SystemExit(str(loaded.diagnostics[0]))
    options = RunOptions(model=MotionModel(smoothing=smoothing))
    return simulate(loaded.program, robot, options=options).only


def _points(run: RobotRun, move: int) -> np.ndarray:
    """The TCP (k, 3) [mm] while a move and those after it are made."""
    start_s = run.moves[move].start_s
    times = np.arange(start_s, run.trajectory.duration, STEP_S)
    return 1e3 * run.trajectory.at(times).base_from_tcp.translation


def _off_a_line(robot: Robot, speed: int, set_ramp: str = "") -> float:
    run = _run(
        robot,
        [
            "MoveL Offs(p,0,-300,0), v500, fine, tool0;",
            set_ramp,
            f"MoveL Offs(p,0,300,0), [{speed},500,5000,1000], fine, tool0;",
        ],
    )
    points = _points(run, 2)
    first, last = points[0], points[-1]
    along = (last - first) / np.linalg.norm(last - first)
    way = points - first
    off = np.linalg.norm(way - np.outer(way @ along, along), axis=1)
    return float(off.max())


def _around_a_point(
    robot: Robot, speed: int, zone: int, smoothing: Smoothing, set_ramp: str = ""
) -> RobotRun:
    return _run(
        robot,
        [
            "MoveL Offs(p,0,-200,0), v500, fine, tool0;",
            set_ramp,
            f"MoveL p, [{speed},500,5000,1000], z{zone}, tool0;",
            f"MoveL Offs(p,0,0,-200), [{speed},500,5000,1000], fine, tool0;",
        ],
        smoothing,
    )


def _off(robot: Robot, run: RobotRun) -> float:
    """Least distance [mm] of the TCP from the point."""
    x, z = ARMS[robot.name]
    return float(np.linalg.norm(_points(run, 2) - [x, 0.0, z], axis=1).min())


def _stop_to_stop(robot: Robot, ramp: int) -> float:
    run = _run(robot, [f"AccSet 100, {ramp};", "MoveL Offs(p,0,100,0), v200, fine, tool0;"])
    return run.moves[-1].end_s - run.moves[-1].start_s


if __name__ == "__main__":
    main()
