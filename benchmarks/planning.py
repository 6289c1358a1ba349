"""How fast motion is planned: small moves by the thousand, and beside toppra.

    python benchmarks/planning.py [--moves 1000 10000 100000] [--no-run]

Prints moves planned a second, in NumPy alone and with numba, for programs of 2 mm moves with zone
z1, planned as a run does it, a few thousand moves at a time; what a move costs in blocks of one and
of three, as most robot programs have them; how long toppra takes for what we solve, on the same
rows and the same grid; and where the time of a whole run goes. Times are those of the processor,
the best of a few; numba is warm, what it costs to load is printed.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib import import_module
from importlib.util import find_spec
from itertools import pairwise
from time import process_time
from typing import Any

import numpy as np
from plain_segments import plain_segment

from rapidsim.controller.journal.journal import Instant
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import QueuedMove, ResolvedMove
from rapidsim.controller.queue.member import Member, member_at_rest
from rapidsim.controller.queue.motion_queue import MAX_OPEN_MOVES, MotionQueue
from rapidsim.diagnostics import Source, Span
from rapidsim.files import SourceFile
from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform, quaternion_from_matrix
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    TOOL0,
    WOBJ0,
    ConfData,
    JointTarget,
    RobJoint,
    SpeedData,
    ZoneData,
)
from rapidsim.language.moves import Interpolation, Move, Place
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.geometry.segments import Geometry, Segment, Speed, Waypoint, Zone
from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.timing.axis_limits import Limits, limits_of
from rapidsim.motion.timing.discretisation import cells_of
from rapidsim.motion.timing.problem import Problem, problem_of
from rapidsim.motion.timing.stages import stages_of
from rapidsim.motion.timing.time_optimal import Division, StageMotion, drive
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

ROBOT = "irb1600-6-1.2"
HOME_DEG = (0.0, -10.0, 20.0, 10.0, 60.0, 20.0)
TOOL = Transform(rotation_from_vector(np.array([0.0, 0.3, 0.0])), np.array([0.05, 0.0, 0.2]))
STEP = 0.002
ROW = 30
ROWS_UP = 50
Z1 = Zone(0.001, 0.001, np.radians(0.1))
REPEATS = 3
RUN_MOVES = 10_000
BLOCKS = 12
BLOCK_MOVES = 501


def main() -> None:
    """Print four tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--moves", type=int, nargs="+", default=[1_000, 10_000, 100_000])
    parser.add_argument("--no-run", action="store_true", help="leave the whole run out")
    options = parser.parse_args()
    robot = load_robot(ROBOT)
    _planning(robot, options.moves)
    _short_blocks(robot)
    _beside_toppra(robot)
    if not options.no_run:
        _whole_run(robot)


@contextmanager
def numba(use: bool) -> Iterator[None]:
    """With compiled loops or without."""
    before = os.environ.get("RAPIDSIM_NUMBA")
    os.environ["RAPIDSIM_NUMBA"] = "1" if use else "0"
    try:
        yield
    finally:
        os.environ.pop("RAPIDSIM_NUMBA")
        if before is not None:
            os.environ["RAPIDSIM_NUMBA"] = before


def print_moves(robot: Robot, count: int, speed_m_s: float) -> list[Segment]:
    """A part printed in layers: rows of small lines, the tool slowly tilting."""
    home = np.radians(HOME_DEG)
    start = robot.kinematics.forward(home) @ TOOL
    number = np.arange(count + 1)
    row, within = np.divmod(number, ROW + 1)
    layer, row = np.divmod(row, ROWS_UP)
    aside = np.where(row % 2 == 0, within, ROW - within)
    points = STEP * np.stack([row, np.minimum(aside, ROW), layer % ROWS_UP], axis=1)
    tilt = 0.1 * np.sin(0.01 * number)[:, None] * np.array([0.0, 1.0, 0.0])
    poses = Transform(rotation_from_vector(tilt) @ start.rotation, start.translation + points)
    followed = robot.kinematics.inverse_on_branch(poses @ TOOL.inverse(), 0, home)
    if not followed.exists.all():
        raise SystemExit("the arm does not reach the part")
    points_and_joints = [Waypoint(followed.joints[i], poses[i]) for i in number]
    speed = Speed(speed_m_s, np.radians(500.0))
    return [
        plain_segment(
            geometry=Geometry.LINE,
            start=points_and_joints[i],
            end=points_and_joints[i + 1],
            tcp_from_flange=TOOL.inverse(),
            branch=0,
            speed=speed,
            zone=Z1 if i < count - 1 else None,
        )
        for i in range(count)
    ]


def pick_moves(robot: Robot, count: int, moves_a_block: int) -> list[Segment]:
    """Lines and joint moves by turns between places in a cube of 300 mm.

    The last of each block goes to `fine`, the others have z10.
    """
    home = np.radians(HOME_DEG)
    centre = robot.kinematics.forward(home) @ TOOL
    random = np.random.default_rng(1)
    points = random.uniform(-0.15, 0.15, (count + 1, 3))
    turns = random.uniform(-0.2, 0.2, (count + 1, 3))
    poses = Transform(rotation_from_vector(turns) @ centre.rotation, centre.translation + points)
    followed = robot.kinematics.inverse_on_branch(poses @ TOOL.inverse(), 0, home)
    ends = [Waypoint(followed.joints[i], poses[i]) for i in range(count + 1)]
    zone, speed = Zone(0.01, 0.015, np.radians(1.0)), Speed(0.5, np.radians(500.0))
    return [
        plain_segment(
            geometry=Geometry.JOINT if i % 2 else Geometry.LINE,
            start=ends[i],
            end=ends[i + 1],
            tcp_from_flange=TOOL.inverse(),
            branch=0,
            speed=speed,
            zone=zone if (i + 1) % moves_a_block else None,
        )
        for i in range(count)
    ]


def plan_as_a_run(robot: Robot, segments: Sequence[Segment]) -> float:
    """Plan moves as a run does and return how long they take [s]."""
    return planned(robot, segments).trajectory.command_end


def planned(robot: Robot, segments: Sequence[Segment]) -> Member:
    """Plan moves as a run does; the last one must stop."""
    member = member_at_rest(robot, MotionModel(), segments[0].start)
    queue = MotionQueue((member,))
    move = Move(
        "MoveL",
        Interpolation.LINE,
        JointTarget(RobJoint(0, 0, 0, 0, 0, 0), NO_EXTERNAL_AXES),
        SpeedData(100, 500, 5000, 1000),
        ZoneData(False, 1, 1, 1, 0.1, 1, 0.1),
        TOOL0,
        WOBJ0,
    )
    place = Place(Span(Source("print.mod", ""), 0, 0), "main")
    conf = ConfData(0, 0, 0, 0)
    now_s = 0.0
    for segment in segments:
        corner = CornerKind.FLY_BY if segment.zone else CornerKind.STOP
        end, tool = segment.end.base_from_tcp, segment.tcp_from_flange
        of = ResolvedMove(move, place, conf)
        queued = QueuedMove(of, segment, Instant(), corner, end, tool)
        queue.append((queued,), -np.inf if queue.is_open else now_s)
        if segment.zone is None:
            now_s = queue.close()
        elif queue.open_moves > MAX_OPEN_MOVES:
            queue.commit_ahead()
    return member


def _planning(robot: Robot, counts: Sequence[int]) -> None:
    print(f"{robot.title}: moves of 2 mm, z1, planned {MAX_OPEN_MOVES} at a time\n")
    print(f"{'moves':>8}{'speed':>8}{'NumPy':>12}{'numba':>12}  moves/s     motion  nodes a move")
    with_numba = find_spec("numba") is not None
    if with_numba:
        with numba(use=True):
            seconds, _ = timed(robot, print_moves(robot, 5000, 0.1), 1)
        print(f"{'':>28}(loading compiled code and the first 5,000 moves: {seconds:.1f} s)")
    spent: dict[tuple[bool, float, int], float] = {}
    for speed in (0.1, 0.5):
        for count in counts:
            segments = print_moves(robot, count, speed)
            rates = []
            duration = 0.0
            for use in (False, True)[: 1 + with_numba]:
                with numba(use=use):
                    repeats = REPEATS if count < 50_000 else 1
                    seconds, duration = timed(robot, segments, repeats)
                spent[use, speed, count] = seconds
                rates.append(f"{count / seconds:12,.0f}")
            columns = "".join(rates) if with_numba else rates[0] + f"{'-':>12}"
            pieces = planned(robot, segments[-min(count, 5000) :]).trajectory.pieces
            nodes = sum(len(piece.timing.s) for piece in pieces) / min(count, 5000)
            print(
                f"{count:>8}{f'v{speed * 1e3:g}':>8}{columns}{'':>10}{duration:9.2f} s{nodes:10.1f}"
            )
    for (use, speed, count), seconds in spent.items():
        ten = spent.get((use, speed, 10 * count))
        if ten is not None:
            way = "numba" if use else "NumPy"
            print(
                f"{way}, v{speed * 1e3:g}: ten times {count} moves cost {ten / seconds:.1f} times"
            )


def _short_blocks(robot: Robot) -> None:
    print(f"\n{BLOCK_MOVES} lines and joint moves of some 200 mm at v500")
    print(f"{'':>24}{'NumPy':>12}{'numba':>12}  ms a move")
    for moves_a_block, name in ((1, "each to fine"), (3, "every third to fine")):
        segments = pick_moves(robot, BLOCK_MOVES, moves_a_block)
        columns = ""
        for use in (False, True)[: 1 + (find_spec("numba") is not None)]:
            with numba(use=use):
                seconds, _ = timed(robot, segments, REPEATS)
            columns += f"{seconds / BLOCK_MOVES * 1e3:12.2f}"
        print(f"{name:>24}{columns}")


def timed(robot: Robot, segments: Sequence[Segment], repeats: int) -> tuple[float, float]:
    """Processor time of planning moves, the best of some, and how long the moves take [s]."""
    best, duration = np.inf, 0.0
    for _ in range(repeats):
        begin = process_time()
        duration = plan_as_a_run(robot, segments)
        best = min(best, process_time() - begin)
    return float(best), duration


@dataclass(frozen=True)
class BesideToppra:
    """The same rows on the same grid, solved by toppra and by us."""

    compiled: bool
    nodes: int
    theirs_s: float
    ours_s: float
    difference: float
    """Of durations, the largest as a share."""


def _beside_toppra(robot: Robot) -> None:
    if find_spec("toppra") is None:
        print("\ntoppra is not installed and was left out")
        return
    print(f"\n{BLOCKS} blocks of 20 lines, the same rows on the same grid")
    print(f"{'':>12}{'grid':>8}{'toppra ms':>12}{'ours ms':>10}{'ratio':>8}  duration differs by")
    for one in beside_toppra(robot):
        way = "with numba" if one.compiled else "NumPy"
        print(
            f"{way:>12}{one.nodes:>8}{one.theirs_s * 1e3:12.0f}{one.ours_s * 1e3:10.1f}"
            f"{one.theirs_s / one.ours_s:8.0f}  {one.difference:.1e}"
        )


def beside_toppra(robot: Robot) -> Iterator[BesideToppra]:
    """Measure both, in NumPy and, where it is installed, with numba."""
    # The model whose limits know nothing of zones, as the other solver's.
    model = replace(MODELS["1"], filter_time=0.0)
    limits = limits_of(robot, model)
    random = np.random.default_rng(1)
    blocks = [_random_block(robot, random) for _ in range(BLOCKS)]
    for part in ("", ".algorithm", ".constraint", ".interpolator"):
        # What it costs to import is none of the solver's.
        import_module(f"toppra{part}")
    for use in (False, True)[: 1 + (find_spec("numba") is not None)]:
        theirs, ours, nodes, worst = 0.0, 0.0, 0, 0.0
        for segments in blocks:
            path = build_path(robot, segments, model)
            assert isinstance(path, Path), path
            cells = cells_of(path, limits, 0.0)
            begin = process_time()
            expected = toppra_duration(path, limits, cells)
            theirs += process_time() - begin
            with numba(use=use):
                best, found = np.inf, 0.0
                for _ in range(REPEATS):
                    begin = process_time()
                    problem = problem_of(path, cells, limits)
                    found = float(drive_on_cells(problem).times.sum())
                    best = min(best, process_time() - begin)
                ours += best
            worst = max(worst, abs(found / expected - 1.0))
            nodes += len(cells.at) + 1
        yield BesideToppra(use, nodes, theirs, ours, worst)


def _random_block(robot: Robot, random: np.random.Generator) -> list[Segment]:
    """Twenty lines within a cube of 200 mm with zones of 10 mm, at the speed of the axes."""
    home = np.radians(HOME_DEG)
    centre = robot.kinematics.forward(home) @ TOOL
    points = np.concatenate([[np.zeros(3)], random.uniform(-0.1, 0.1, (20, 3))])
    turns = np.concatenate([[np.zeros(3)], random.uniform(-0.1, 0.1, (20, 3))])
    poses = Transform(rotation_from_vector(turns) @ centre.rotation, centre.translation + points)
    followed = robot.kinematics.inverse_on_branch(poses @ TOOL.inverse(), 0, home)
    ends = [Waypoint(followed.joints[i], poses[i]) for i in range(21)]
    zone = Zone(0.01, 0.01, np.radians(1.0))
    speed = Speed(7.0, 1e3)
    return [
        plain_segment(Geometry.LINE, a, b, TOOL.inverse(), 0, speed, zone if i < 19 else None)
        for i, (a, b) in enumerate(pairwise(ends))
    ]


def drive_on_cells(problem: Problem) -> StageMotion:
    """The fastest drive from rest with the ends of the cells as its only nodes."""
    stages = stages_of(problem.cells, problem.accelerations, 1)
    held = np.zeros(len(stages.cell), dtype=bool)
    return drive(problem, Division(stages, held, 0), 0.0)


def toppra_duration(path: Path, limits: Limits, cells: Any) -> float:
    """Duration [s] that toppra finds for the rows at the nodes of cells."""
    toppra = import_module("toppra")
    algorithm = import_module("toppra.algorithm")
    constraint = import_module("toppra.constraint")
    interpolator = import_module("toppra.interpolator")
    nodes = np.append(cells.s[:, 0], cells.s[-1, 2])
    at = np.append(cells.at[:, 0], cells.at[-1, 2])
    rates = cells.places.rates
    first, second, tcp_rate = rates.first[at], rates.second[at], rates.tcp_rate[at]

    class Exact(interpolator.AbstractGeometricPath):  # type: ignore[misc, name-defined]
        """The path with the TCP's travel as one more axis."""

        dof = 7
        path_interval = np.array([0.0, path.length])

        def __call__(self, s: Array, order: int = 0) -> Array:
            where = np.searchsorted(nodes, np.atleast_1d(s) - 1e-12)
            extra = tcp_rate if order == 1 else np.zeros(len(nodes))
            rows = first if order == 1 else second if order == 2 else np.zeros_like(first)
            values: Array = np.concatenate([rows, extra[:, None]], axis=1)[where]
            return values if np.ndim(s) else values[0]

    speed = np.append(limits.max_speed, path.segments[0].speed.tcp)
    acceleration = np.append(limits.max_acceleration, 1e6)
    scheme = constraint.DiscretizationType.Interpolation
    toppra.setup_logging("ERROR")
    solver = algorithm.TOPPRA(
        [
            constraint.JointVelocityConstraint(np.stack([-speed, speed], axis=1)),
            constraint.JointAccelerationConstraint(
                np.stack([-acceleration, acceleration], axis=1), discretization_scheme=scheme
            ),
        ],
        Exact(),
        gridpoints=nodes,
    )
    _, speeds, _ = solver.compute_parameterization(0.0, 0.0)
    return float((2.0 * np.diff(nodes) / (speeds[1:] + speeds[:-1])).sum())


def _whole_run(robot: Robot) -> None:
    """Where the time of a run of many moves goes."""
    text = program_text(robot, print_moves(robot, RUN_MOVES, 0.1))
    begin = process_time()
    loaded = load([SourceFile("print.mod", text, "utf-8")])
    read_s = process_time() - begin
    if loaded.program is None:
        raise SystemExit("the program has errors")
    print(f"\na program of {RUN_MOVES:,} moves: {read_s:.1f} s to read and check it")
    for use in (False, True)[: 1 + (find_spec("numba") is not None)]:
        with numba(use=use):
            begin = process_time()
            run = simulate(loaded.program, robot, options=RunOptions())
            seconds = process_time() - begin
        way = "with numba" if use else "in NumPy"
        print(f"{way}: {seconds:.1f} s to run it, {len(run.moves) / seconds:,.0f} moves/s")


def program_text(robot: Robot, segments: Sequence[Segment]) -> str:
    """The moves as a RAPID module."""
    lines = [
        "MODULE print_part",
        f"PERS tooldata t:=[TRUE,{_pose(TOOL)},[1,[0,0,1],[1,0,0,0],0,0,0]];",
    ]
    lines += ["PROC main()", f"MoveJ {_target(robot, segments[0].start)},v1000,fine,t;"]
    for segment in segments:
        zone = "z1" if segment.zone else "fine"
        lines.append(f"MoveL {_target(robot, segment.end)},v100,{zone},t;")
    return "\n".join([*lines, "ENDPROC", "ENDMODULE", ""])


def _target(robot: Robot, waypoint: Waypoint) -> str:
    conf = ",".join(str(int(one)) for one in confdata_of(robot.kinematics, waypoint.joints))
    return f"{_pose(waypoint.base_from_tcp)[:-1]},[{conf}],[9E9,9E9,9E9,9E9,9E9,9E9]]"


def _pose(frame: Transform) -> str:
    place = ",".join(f"{1e3 * one:.4f}" for one in frame.translation)
    turn = ",".join(f"{one:.8f}" for one in quaternion_from_matrix(frame.rotation))
    return f"[[{place}],[{turn}]]"


if __name__ == "__main__":
    main()
