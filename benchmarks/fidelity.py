"""How near the motion model comes to a real controller: recorded moves beside our own run of them.

    python benchmarks/fidelity.py TRACES.json

Every trace holds a RAPID program and the joint angles a controller logged while it ran. The program
goes through the whole of rapidsim (parse, check, run, plan) and the two motions are compared: with
the default model, in which nothing is fitted to the arm, and with the accelerations measured on
that arm, each with smoothing along the path and of each axis. `docs/fidelity.md` says what the
columns mean.
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from rapidsim.applications.calibrate.log_comparison import MotionByPlace
from rapidsim.files import SourceFile
from rapidsim.frames.transform import Array
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate

ROBOT = "irb6640-180-2.55"
CLOCK = 1.008
"""Controller time in units of log time: the interpolation cycle of 4.032 ms was logged as 4 ms."""
APPROACH_MOVES = 2
"""The program first moves to the start, twice."""
ELBOW_AND_WRIST = slice(2, 6)
"""Axes 3 to 6: the log shows axes 1 and 2 on the motor side of an elastic drive."""
ELASTIC_S2 = np.array([[2.5e-4, -0.9e-4, -0.5e-4], [0.2e-4, 3.3e-4, 1.0e-4]])
"""Motor angle less link angle of axes 1 and 2 for each unit of acceleration of axes 1 to 3."""
STILL_M_S = 0.05
"""Slower than this, the place says little about the time."""
NEAR_M = 0.02
"""The log has rows this near to a point, or it says nothing about it."""
RAMP_S = 0.2
SPAN_S = 0.08


@dataclass(frozen=True, slots=True)
class Fidelity:
    """How far our run of a trace is from the log; see `docs/fidelity.md`."""

    name: str
    end_percent: float
    """Time of ours less time of the log at the last logged place, as a share of the latter."""
    time_rms_ms: float
    via_rms_ms: float
    """The same at the programmed points that both pass without stopping; NaN without any."""
    corner_speed_percent: float
    """RMS difference of path speed at those points; NaN without any."""
    ramp_rms_mm_s: float
    """RMS difference of the logged TCP speed in the first 0.2 s."""
    off_path_deg: float
    """RMS distance of axes 3 to 6 from our path."""
    corner_cut_mm: float
    """RMS difference of how near the TCP comes to the points passed, on the motor side; NaN without
    any."""


def main() -> None:
    """Print one table a model."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    beside = Path(__file__).parents[2] / "shared" / "reference" / "abb_traces_dev.json"
    parser.add_argument("traces", type=Path, nargs="?", default=beside)
    file = parser.parse_args().traces
    if not file.is_file():
        parser.error(f"{file} is not here; name a file of traces")
    traces = read_traces(file)
    for title, model in (
        ("axis acceleration = axis speed / 0.16 s", default_model()),
        ("torques measured on this arm", measured_model()),
        ("version 1", MODELS["1"]),
    ):
        print(f"\n{title}")
        print(
            f"{'trace':<20}{'smoothed':>9}{'end %':>8}{'time ms':>9}{'vias ms':>9}{'corners %':>11}"
            f"{'ramp mm/s':>11}{'off path deg':>14}{'cut mm':>8}"
        )
        for smoothing in ("path", "axes"):
            for f in fidelities(traces, replace(model, smoothing=smoothing)):
                print(
                    f"{f.name:<20}{smoothing:>9}{f.end_percent:>+8.2f}{f.time_rms_ms:>9.1f}"
                    f"{f.via_rms_ms:>9.1f}{f.corner_speed_percent:>11.1f}{f.ramp_rms_mm_s:>11.1f}"
                    f"{f.off_path_deg:>14.3f}{f.corner_cut_mm:>8.2f}"
                )


def read_traces(file: Path) -> list[Mapping[str, Any]]:
    """The traces of a file, in its order."""
    traces: list[Mapping[str, Any]] = json.loads(file.read_text(encoding="utf-8"))["traces"]
    return traces


def default_model() -> MotionModel:
    """What is assumed of an arm on which nothing was measured."""
    return MotionModel(own_accelerations=False)


def measured_model() -> MotionModel:
    """With this arm's own torques, which the catalogue holds."""
    return MotionModel()


def fidelities(traces: Sequence[Mapping[str, Any]], model: MotionModel) -> list[Fidelity]:
    """Run the programs of all traces and compare.

    A log starts when its first digit changes, and how long after the start of the command that is
    nobody knows: it depends on the shape of the first milliseconds and on the digits logged. All
    traces that start from the same pose with the same kind of move share one such offset, the one
    that makes the differences of the angles of axes 3 to 6 least.
    """
    compared = [_compare(trace, model) for trace in traces]
    offsets = {
        kind: _offset_s([one for one in compared if one.kind == kind])
        for kind in {one.kind for one in compared}
    }
    return [_fidelity(one, offsets[one.kind]) for one in compared]


def _offset_s(compared: Sequence[_Compared]) -> float:
    """The common lead [s] of some traces, each of the same weight."""
    above, below = 0.0, 0.0
    for one in compared:
        weights = _joint_speed(one) ** 2 / len(one.place)
        above += float(weights @ one.lead)
        below += float(weights.sum())
    return above / below


def _joint_speed(one: _Compared) -> Array:
    """How fast (k,) [rad/s] axes 3 to 6 of ours turn at the places of the log."""
    step = 2e-3
    times = one.ours.time_at(one.place) + one.ours.start_s
    before, after = (one.run.only.trajectory.at(times + s).joints for s in (-step, step))
    speed: Array = np.linalg.norm((after - before)[:, ELBOW_AND_WRIST], axis=1) / (2.0 * step)
    return speed


@dataclass(frozen=True, slots=True, eq=False)
class _Compared:
    """One trace beside our run of it; rows are those of the log in which the arm moves."""

    trace: Mapping[str, Any]
    run: Simulation
    ours: MotionByPlace
    vias: Array
    """Places (v,) [m] of the programmed points that both pass without stopping."""
    points: Array
    """Those points (v, 3) [m], in base."""
    log: Array
    """Shape (r, n) [rad]: all logged joints."""
    times: Array
    """Shape (k,) [s] since the first digit of the log changed."""
    place: Array
    """Shape (k,) [m]: nearest place of our path."""
    distance: Array
    """Shape (k,) [rad]: how near."""
    lead: Array
    """Shape (k,) [s]: our time at that place, since the command started, less the log's."""

    @property
    def kind(self) -> str:
        """The instruction of the recorded moves."""
        return self.run.moves[-1].move.instruction


def _compare(trace: Mapping[str, Any], model: MotionModel) -> _Compared:
    robot = load_robot(ROBOT)
    loaded = load([SourceFile(f"{trace['name']}.mod", trace["rapid"], "utf-8")])
    assert loaded.program is not None, loaded.diagnostics
    run = simulate(loaded.program, robot, options=RunOptions(model=model))
    moves = [move for move in run.moves if move.index >= APPROACH_MOVES]
    rows = np.array(trace["samples"])
    first, last = trace.get("valid_window_s") or (-math.inf, math.inf)
    rows = rows[(rows[:, 0] >= first) & (rows[:, 0] <= last)]
    ours = MotionByPlace.of(run.only.trajectory, moves[0].start_s)
    times = rows[:, 0] * CLOCK
    place, distance = ours.nearest(np.radians(rows[:, 1:]), ELBOW_AND_WRIST)
    moving = ours.speed_at(place) > STILL_M_S
    times, place, distance = times[moving], place[moving], distance[moving]
    ends = np.cumsum([move.length_m for move in moves]) + ours.places[0]
    passed = [
        (end, move.base_from_tcp.translation)
        for move, end in zip(moves, ends, strict=True)
        if move.zone_m > 0.0 and np.abs(place - end).min() < NEAR_M and end < place[-1]
    ]
    vias = np.array([end for end, _ in passed])
    points = np.array([point for _, point in passed]).reshape(-1, 3)
    lead = ours.time_at(place) - times
    log = np.radians(rows[:, 1:])
    return _Compared(trace, run, ours, vias, points, log, times, place, distance, lead)


def _fidelity(one: _Compared, offset_s: float) -> Fidelity:
    error = one.lead - offset_s
    log_at = np.interp(one.vias, one.place, one.times)
    log_speed = _mean_speed(log_at, one.times, one.place)
    our_at = one.ours.time_at(one.vias)
    fine = np.arange(our_at[0] - SPAN_S, our_at[-1] + SPAN_S, 1e-3) if len(our_at) else our_at
    our_speed = _mean_speed(our_at, fine, one.ours.place_at(fine))
    return Fidelity(
        name=one.trace["name"],
        end_percent=100.0 * float(error[-1] / one.times[-1]),
        time_rms_ms=1e3 * _rms(error),
        via_rms_ms=1e3 * _rms(our_at - log_at - offset_s),
        corner_speed_percent=100.0 * _rms(our_speed / log_speed - 1.0),
        ramp_rms_mm_s=1e3 * _ramp(one, offset_s),
        off_path_deg=math.degrees(_rms(one.distance)),
        corner_cut_mm=1e3 * _rms(_cut(one)),
    )


def _cut(one: _Compared) -> Array:
    """How much nearer (v,) [m] ours passes the programmed points than the log does.

    The log is straight between its rows. Both are on the motor side.
    """
    tcp_from_flange = one.run.moves[-1].tcp_from_flange
    logged = (one.run.only.robot.forward(one.log) @ tcp_from_flange.inverse()).translation
    ours = _motor_side(one.run, np.arange(one.ours.start_s, one.run.only.trajectory.duration, 1e-3))
    nearest = [_distance(point, logged) - _distance(point, ours) for point in one.points]
    return np.array(nearest)


def _distance(point: Array, line: Array) -> float:
    """Distance [m] of a point (3,) from straight lines between points (k, 3)."""
    start, step = line[:-1], np.diff(line, axis=0)
    along = np.einsum("ki,ki->k", point - start, step)
    share = along / np.maximum(np.einsum("ki,ki->k", step, step), 1e-18)
    foot = start + np.clip(share, 0.0, 1.0)[:, None] * step
    return float(np.linalg.norm(foot - point, axis=1).min())


def _mean_speed(at: Array, times: Array, place: Array) -> Array:
    """Mean path speed (v,) [m/s] over `SPAN_S` around each time `at` (v,) [s].

    Where the controller cuts a corner, the nearest place of our path jumps; over the width of the
    smoothing that evens out.
    """
    if not len(at):
        return np.empty(0)
    before, after = (np.interp(at + s * SPAN_S / 2, times, place) for s in (-1.0, 1.0))
    speed: Array = (after - before) / SPAN_S
    return speed


def _ramp(one: _Compared, offset_s: float) -> float:
    """RMS difference [m/s] of the logged TCP speed, which is that of the motor side."""
    logged = np.array([row for row in one.trace["tcp_speed"] if 0.0 < row[0] * CLOCK < RAMP_S])
    times = one.ours.start_s + offset_s + logged[:, 0] * CLOCK
    step = 1e-3
    before, after = (_motor_side(one.run, times + s) for s in (-step, step))
    ours = np.linalg.norm(after - before, axis=1) / (2.0 * step)
    return _rms(ours - 1e-3 * logged[:, 1] / CLOCK)


def _motor_side(run: Simulation, times: Array) -> Array:
    """Where the TCP (k, 3) [m] would be if the links were where the motors say."""
    step = 2e-3
    before, now, after = (run.only.trajectory.at(times + s).joints for s in (-step, 0.0, step))
    acceleration = (after - 2.0 * now + before) / step**2
    joints = now.copy()
    joints[:, :2] += acceleration[:, :3] @ ELASTIC_S2.T
    base_from_tcp = run.only.robot.forward(joints) @ run.moves[-1].tcp_from_flange.inverse()
    translation: Array = base_from_tcp.translation
    return translation


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else math.nan


if __name__ == "__main__":
    main()
