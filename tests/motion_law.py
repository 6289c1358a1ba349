"""Measures, on samples 1 ms apart, how far a trajectory is from what its arm and program allow."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from laws import cases

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.model import Smoothing
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.trajectory.command import MotionCommand, Piece
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory

STEP = 1e-3
MOST_SAMPLES = cases(15_000)
"""So much of a long run is looked at, in stretches all over it."""
_STRETCH = 200


@dataclass(frozen=True, slots=True)
class Excess:
    """The largest share of each limit that was used; 1 is the limit."""

    axis_speed: float
    axis_acceleration: float
    """Or torque, where that limits an axis."""
    tcp_speed: float


def command_of(trajectory: Trajectory) -> Trajectory:
    """The same motion before smoothing and ramps."""
    return _following(trajectory, trajectory._ramped.planned)


def ramped_command_of(trajectory: Trajectory) -> Trajectory:
    """The same motion before smoothing, with its ramps."""
    return _following(trajectory, trajectory._ramped.command)


def _following(trajectory: Trajectory, command: MotionCommand) -> Trajectory:
    other = Trajectory(trajectory._start, 0.0)
    other._ramped.planned = other._ramped.command = command
    return other


def with_smoothed(what: Smoothing, trajectory: Trajectory) -> Trajectory:
    """The same command, smoothed along the path, or each axis by itself."""
    windows, late = trajectory._windows, 0.0
    other = Trajectory(trajectory._start, windows.filter_time, what, windows.averages)
    for piece in trajectory.pieces:
        begin = piece.start_time + late
        # After a slow stop the command may go on before the arm has come to rest.
        if what == "path" and begin > other.command_end + 1e-9:
            late += max(0.0, other.duration - begin)
        other.append(replace(piece, start_time=piece.start_time + late))
    return other


def excess_of(trajectory: Trajectory, limits: Limits, most: int = MOST_SAMPLES) -> Excess:
    """How much of the limits a motion uses; AccSet and programmed speeds are those of its moves."""
    share, speed, load = _of_moves(trajectory.pieces)
    times, samples = sampled(trajectory, most)
    joints = np.concatenate([samples.joints, samples.external], axis=1)
    rates = np.diff(joints.reshape(*times.shape, -1), axis=1) / STEP
    changes = np.diff(rates, axis=1) / STEP
    allowed = _largest_of_neighbours(share[samples.move].reshape(times.shape))
    used = np.abs(changes) / limits.max_acceleration
    middle = 0.5 * (rates[:, 1:] + rates[:, :-1])
    inner = samples.joints.reshape(*times.shape, -1)[:, 1:-1]
    hangs = load[samples.move].reshape(times.shape)[:, 1:-1].ravel()
    stance = trajectory.pieces[0].path.kinematics.stance(inner.reshape(-1, inner.shape[-1]))
    for arm in limits.arms:
        speed_there, change = (one.reshape(-1, one.shape[-1]) for one in (middle, changes))
        shares = np.abs(arm.shares(stance, speed_there, change, hangs))
        used[..., arm.axes] = shares.reshape(*inner.shape[:2], 3)
    return Excess(
        axis_speed=float((np.abs(rates) / limits.max_speed).max(initial=0.0)),
        axis_acceleration=float((used / allowed[..., None]).max(initial=0.0)),
        tcp_speed=float((samples.tcp_speed / speed[samples.move]).max(initial=0.0)),
    )


@lru_cache(maxsize=1)
def sampled(trajectory: Trajectory, most: int) -> tuple[Array, Samples]:
    """Instants (b, k) [s] of a finished motion, and where the arm is then (b * k)."""
    times = instants(trajectory, most)
    return times, trajectory.at(times.ravel())


def instants(trajectory: Trajectory, most: int) -> Array:
    """Instants (b, k) [s] in b stretches, from just before a motion to just after it."""
    count = int(trajectory.duration / STEP) + 5
    stretches = 1 if count <= most else most // _STRETCH
    length = count if stretches == 1 else _STRETCH
    begins = np.linspace(-2.0, count - 2.0 - length, stretches)
    spread: Array = STEP * (begins[:, None] + np.arange(length))
    return spread


def _of_moves(pieces: tuple[Piece, ...]) -> tuple[Array, Array, Array]:
    """Share of the axis accelerations, programmed TCP speed [m/s] and load of each move of a run.

    Moves with a time of their own have no speed, and on arcs that two wrist axes lead it is not the
    TCP's; in the middle of a corner speeds change.
    """
    count = max(piece.first + len(piece.path.segments) for piece in pieces)
    share, speed, load = np.ones(count), np.full(count, np.inf), np.zeros(count)
    for piece in pieces:
        for number, segment in piece.numbered:
            share[number] = segment.acceleration_share
            load[number] = segment.load
            of_tcp = segment.duration is None and segment.wrist_pair is None
            speed[number] = segment.speed.tcp if of_tcp else np.inf
    return share, speed, load


def _largest_of_neighbours(values: Array) -> Array:
    return np.maximum(np.maximum(values[:, :-2], values[:, 1:-1]), values[:, 2:])


def off_curve(trajectory: Trajectory) -> float:
    """Largest distance [m] of the TCP from programmed lines and arcs, where no corner cuts them.

    On arcs that two wrist axes lead it is that of the z axis of the tool where it passes the plane.
    The TCP is found from the joints that were sampled, so this measures the arm, not its plan.
    """
    _, samples = sampled(trajectory, MOST_SAMPLES)
    places = trajectory.place_at(samples.times)
    worst = 0.0
    begin = 0.0
    for piece in trajectory.pieces:
        end = begin + piece.to_s - piece.from_s
        at = np.flatnonzero((places > begin) & (places < end)).astype(np.int64)
        worst = max(worst, _off_path(piece.path, places[at] - begin + piece.from_s, samples, at))
        begin = end
    return worst


def _off_path(path: Path, s: Array, samples: Samples, at: Index) -> float:
    layout, curves = path.layout, path.layout.curves
    piece = layout.piece_at(s)
    row = layout.row[piece]
    cut = np.maximum(layout.position_corner[piece], layout.joint_corner[piece]) >= 0
    on_curve = np.flatnonzero(~cut & ~curves.in_joints[row])
    if not len(on_curve):
        return 0.0
    row = row[on_curve]
    joints = np.concatenate([samples.joints, samples.external], axis=1)[at[on_curve]]
    tcp = path.arms.curve_from_tcp(joints, row)
    start, spoke = curves.start.translation[row], curves.spoke[row]
    to_tcp = tcp.translation - start
    chord = curves.chord[row]
    along = chord / np.maximum(np.linalg.norm(chord, axis=-1), 1e-12)[:, None]
    off_line = np.linalg.norm(np.cross(along, to_tcp), axis=-1)
    radius = np.linalg.norm(spoke, axis=-1)
    axis = curves.frame_turn[row]
    axis = axis / np.maximum(np.linalg.norm(axis, axis=-1), 1e-12)[:, None]
    led = np.flatnonzero(path.arms.pair_rows[row])
    z = tcp.rotation[led, :, 2]
    height, fall = (np.einsum("ki,ki->k", part, axis[led]) for part in (to_tcp[led], z))
    to_tcp[led] -= (height / fall)[:, None] * z
    from_centre = to_tcp + spoke
    off_plane = np.einsum("ki,ki->k", from_centre, axis)
    off_arc = np.hypot(np.linalg.norm(from_centre, axis=-1) - radius, off_plane)
    return float(np.where(radius > 0.0, off_arc, off_line).max())
