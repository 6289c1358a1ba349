"""Data of a report's pictures: path, poses, curves over time, moves, signals.

Lengths are mm and angles degrees in the base frame of the robot, thinned out so that a page stays
small however long the run was.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from rapidsim.colours import SPEEDS
from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.report.html.arm_shapes import arm_data
from rapidsim.report.html.cell_objects import objects_data
from rapidsim.report.html.packing import packed, packed_columns
from rapidsim.simulation.results.move_kinds import CORNER, DRAWN_KINDS, MOVE_KINDS
from rapidsim.simulation.results.relative_motion import (
    is_shown_in_world,
    shown_end,
    shown_from_base,
)
from rapidsim.simulation.results.sampling import SampledRun, evaluate, sampled
from rapidsim.simulation.results.signal_history import signal_changes
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.simulation.results.time_shares import end_point

MOST_SAMPLES = 12_000
MOST_MOVES = 12_000
"""Number of moves above which they have neither separate samples nor a lane."""
MOST_NAMES = 60
MOST_POSES = 500
MOST_MARKS = 500
_DEFAULT_DT = 0.012
_MM = 1000.0
_NAME_LETTERS = 24


def motion_data(simulation: Simulation) -> dict[str, object]:
    """The data of the pictures as JSON values."""
    robots = simulation.robots
    end_s = simulation.motion_end_s
    step_s = max(_DEFAULT_DT, len(robots) * end_s / MOST_SAMPLES)
    return {
        "end": round(end_s, 6),
        "step_ms": round(1000.0 * step_s),
        "kinds": DRAWN_KINDS,
        "speeds": SPEEDS,
        "frame": "world" if is_shown_in_world(simulation) else "base",
        "robots": [
            _robot(sampled(simulation, one, step_s, most_moves=MOST_MOVES)) for one in robots
        ],
        "objects": objects_data(simulation, np.linspace(0.0, end_s, MOST_POSES)),
        "pose_step": end_s / (MOST_POSES - 1),
        "signals": _signals(simulation),
        "marks": _marks(simulation.events),
    }


def _robot(run: SampledRun) -> dict[str, object]:
    one, samples = run.robot_run, run.samples
    in_world = is_shown_in_world(run.simulation)
    shown = shown_from_base(one, samples.external, in_world=in_world)
    tcp = shown.apply(samples.base_from_tcp.translation)
    return {
        "task": one.task,
        "title": one.robot.title,
        "t": packed(samples.times, 4),
        "tcp": packed_columns(_MM * tcp, 1),
        "kind": packed(_kinds(run), 0),
        "speed": packed(_MM * samples.tcp_speed, 1),
        "units": one.robot.units(),
        "joints": packed_columns(np.degrees(samples.joints), 2),
        "range": packed_columns(run.range_shares, 1),
        "joint_speed": packed_columns(run.speed_shares, 1),
        "joint_acceleration": packed_columns(run.acceleration_shares, 1),
        **_arm(one, run.simulation.motion_end_s, in_world),
        "moves": [_move(move) for move in one.moves] if len(one.moves) <= MOST_MOVES else [],
        "move_count": len(one.moves),
        "targets": _targets(one, in_world),
        "failed": [_failed(move, shown[0]) for move in one.failed_moves],
    }


def _kinds(run: SampledRun) -> Array:
    """Kind of motion at each sample (k,): an index into `DRAWN_KINDS`."""
    moves, samples = run.robot_run.moves, run.samples
    if not moves:
        return np.zeros(len(samples.times))
    numbers = [DRAWN_KINDS.index(MOVE_KINDS[move.move.interpolation]) for move in moves]
    of_move = np.array(numbers, dtype=np.float64)
    kinds = of_move[np.clip(samples.move, 0, len(moves) - 1)]
    return np.where(run.in_corner, float(DRAWN_KINDS.index(CORNER)), kinds)


def _arm(robot_run: RobotRun, end_s: float, in_world: bool) -> dict[str, object]:
    """Data to draw the arm at its joints, or its poses over time if joints do not suffice."""
    samples = evaluate(robot_run.trajectory, np.linspace(0.0, end_s, MOST_POSES))
    arm = arm_data(robot_run.robot)
    step_s = end_s / (MOST_POSES - 1)
    if arm is None:
        return {"arm": None, "poses": _poses(robot_run, samples, step_s, in_world)}
    stands = shown_from_base(robot_run, samples.external, in_world=in_world)
    if np.allclose(stands.matrix, stands[0].matrix):
        stands = stands[:1]
    turns = stands.rotation.reshape(len(stands), -1)
    return {
        "arm": arm,
        "stands": {
            "step": step_s,
            "turn": packed_columns(turns, 6),
            "place": packed_columns(_MM * stands.translation, 1),
        },
    }


def _poses(
    robot_run: RobotRun, samples: Samples, step_s: float, in_world: bool
) -> dict[str, object]:
    """The arm as the row of its joints, base to TCP, at evenly spaced instants."""
    times, kinematics = samples.times, robot_run.robot.kinematics
    links = kinematics.link_frames(samples.joints).translation
    flange = kinematics.forward(samples.joints).translation
    tcp = samples.base_from_tcp.translation
    foot = np.zeros((len(times), 1, 3))
    in_base = np.concatenate([foot, links, flange[:, None], tcp[:, None]], axis=1)
    shown = shown_from_base(robot_run, samples.external, in_world=in_world)
    points = shown[:, None].apply(in_base)
    return {
        "step": step_s,
        "points": points.shape[1],
        "places": packed_columns(_MM * points.reshape(len(times), -1), 0),
    }


def _move(move: ExecutedMove) -> list[object]:
    name = end_point(move.place)
    return [
        round(move.start_s, 4),
        round(move.end_s, 4),
        MOVE_KINDS[move.move.interpolation],
        f"{move.move.instruction} {name[:_NAME_LETTERS]}",
        round(move.move.speed.v_tcp, 1),
        move.place.span.line,
    ]


def _targets(robot_run: RobotRun, in_world: bool) -> list[list[object]]:
    """Names, place, and whether a line or arc leads there, of each target, once.

    Names at one position share a label, with the number of visits. None if there are
    too many to be legible.
    """
    visits: dict[tuple[float, ...], Counter[str]] = {}
    on_lines: set[tuple[float, ...]] = set()
    for move in robot_run.moves:
        shown = shown_end(robot_run, move, in_world=in_world).translation
        place = tuple(round(_MM * float(x), 1) + 0.0 for x in shown)
        visits.setdefault(place, Counter())[end_point(move.place)[:_NAME_LETTERS]] += 1
        if move.move.interpolation.leads_tcp:
            on_lines.add(place)
        if len(visits) > MOST_NAMES:
            return []
    return [[_label(names), *place, place in on_lines] for place, names in visits.items()]


def _label(visits: Counter[str]) -> str:
    first, *others = visits
    times = visits.total()
    more = f" +{len(others)}" if others else ""
    return f"{first}{more}" if times == 1 else f"{first}{more} ({times}×)"


def _failed(failed: FailedMove, pose: Transform) -> dict[str, object]:
    way, at, end = (
        pose.apply(place)
        for place in (failed.curve, failed.fails_at, failed.base_from_tcp.translation)
    )
    return {
        "code": failed.violation.code,
        "line": failed.place.span.line,
        "way": _points(way),
        "at": _points(at[None])[0],
        "end": _points(end[None])[0],
    }


def _points(places: Array) -> list[list[float]]:
    rounded: list[list[float]] = np.round(_MM * places, 1).tolist()
    return rounded


def _signals(simulation: Simulation) -> list[dict[str, object]]:
    """The values of each signal, by name."""
    return [
        {"name": name, "changes": [[round(time_s, 4), value] for time_s, value in changes]}
        for name, changes in signal_changes(simulation).items()
    ]


def _marks(events: Sequence[Event]) -> list[list[object]]:
    """Instants that plots point at: corners that became stops, limits, errors."""
    told = (EventKind.CORNER, EventKind.LIMIT, EventKind.ERROR)
    marks: list[list[object]] = [
        [round(event.time_s, 4), event.kind.value, event.message]
        for event in events
        if event.kind in told
    ]
    return marks[:MOST_MARKS]
