"""Smoothing of each axis separately: a weighted mean of its commanded angle over the window.

The visible motion then deviates slightly from the path: it rounds corners, as recorded arms do. A
mean never exceeds the speed and acceleration of the averaged motion, so axes keep the limits that
the command keeps.

The command is integrated as polynomials over short parts, which end where its acceleration changes
(the nodes of the timing). Parts belong to the command and are shared by samples, so the cost
depends on the time covered by all windows, for any density of samples.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.trajectory.command import Index, MotionCommand
from rapidsim.motion.trajectory.even_joints import PART_S, PLACES
from rapidsim.motion.trajectory.filter_windows import Windows
from rapidsim.repeated_rows import repeated
from rapidsim.values import value_class

_AT_ONCE = 2_000
"""Number of samples that share their parts, which bounds the memory."""
_COVERED_S, _COARSE_COVERED_S = 4.0, 40.0
"""Length of time [s] that they share at most: its integrals keep their digits."""
_LONGEST_PART_S = 0.016
_PLACES = ((5, 0.002), (3, 0.00025), (2, 0.0))
"""Numbers of Gauss points for parts longer than this [s]; fewer points integrate shorter parts as
well."""
_MOST = 5


def mean_joints(
    command: MotionCommand, windows: Windows, times: Array, *, coarse: bool = False
) -> tuple[Array, Array]:
    """Return visible joints and their rates.

    Args:
        command: Motion command with at least one piece.
        windows: Widths of the smoothing window.
        times: Instants (k,) [s], in any order.
        coarse: Whether 1e-6 suffices, which takes half the time or less.

    Returns:
        Joints of the arm and external axes (k, n + e) [rad, m], within 1e-9 on the paths of the
        tests, and their rates.
    """
    order = np.argsort(times, kind="stable")
    covered = np.cumsum(np.minimum(np.diff(times[order], prepend=-np.inf), windows.widest))
    covered_s = _COARSE_COVERED_S if coarse else _COVERED_S
    chunk = np.maximum(np.arange(len(order)) // _AT_ONCE, covered // covered_s)
    joints = np.empty((len(times), command.axis_count))
    rates = np.empty_like(joints)
    for at in np.split(order, np.flatnonzero(np.diff(chunk)) + 1):
        joints[at], rates[at] = _means(command, windows, times[at], coarse)
    return joints, rates


def _means(
    command: MotionCommand, windows: Windows, times: Array, coarse: bool
) -> tuple[Array, Array]:
    """Return visible joints and their rates for ascending instants (k,) [s]."""
    width, rate, floor = windows.at(times)
    before = np.maximum(times - width, floor)
    place = command.place_at(times)
    moves = command.place_at(before) != place
    joints = np.empty((len(times), command.axis_count))
    rates = np.zeros_like(joints)
    # If the command is at rest during the window, so is the arm, to the last digit.
    still, moving = np.flatnonzero(~moves), np.flatnonzero(moves)
    if len(still):
        _, first, same = np.unique(place[still], return_index=True, return_inverse=True)
        joints[still] = command.joints_at(times[still[first]])[same]
    if len(moving):
        times, before, width, rate = (one[moving] for one in (times, before, width, rate))
        parts = (_even_parts if coarse else _parts)(command, before, times)
        instants = windows.instants(times, width, before)
        begin, *states = np.split(
            parts.at(np.concatenate([before, *instants])), 1 + len(instants), axis=1
        )
        changes = [
            _since(state, begin, (one - before)[:, None])
            for state, one in zip(states, instants, strict=True)
        ]
        mean, rates[moving] = windows.mean(width[:, None], rate[:, None], changes)
        joints[moving] = parts.origin + begin[0] + mean
    return joints, rates


def _since(state: Array, begin: Array, step: Array) -> Array:
    """Return a state (3, k, n) relative to the state (3, k, n) some steps (k, 1) [s] earlier."""
    old, once, _ = begin
    since = state - begin
    since[2] -= step * (once + 0.5 * step * old)
    since[1] -= step * old
    return since


@value_class(frozen=True, slots=True, eq=False)
class _Parts:
    """The command in short parts (m,), in order of time."""

    start: Array
    """Shape (m,) [s]."""
    width: Array
    """Shape (m,) [s]."""
    origin: Array
    """Joints (n,) to which all are relative, so that nearly constant ones lose no digits."""
    powers: Array
    """Joints as a polynomial of the elapsed share of each part, (m, _MOST, n)."""
    integrals: Array
    """Integral and double integral at the start of each part, (2, m, n)."""

    def at(self, times: Array) -> Array:
        """Return joints, their integral and double integral at times (k,) [s], (3, k, n)."""
        part = np.maximum(np.searchsorted(self.start, times, side="right") - 1, 0)
        width = self.width[part][:, None]
        share = np.clip((times - self.start[part]) / width[:, 0], 0.0, 1.0)
        powers = self.powers[part]
        terms = share[:, None] ** np.arange(_MOST + 2)
        once, twice = self.integrals[:, part]
        value, integral, double = (
            np.einsum("kp,kpn->kn", terms[:, order : order + _MOST] * _FALLING[order], powers)
            for order in range(3)
        )
        gone = width * share[:, None]
        return np.stack(
            [value, once + width * integral, twice + gone * once + width * width * double]
        )


_POWERS = np.arange(_MOST)
_FALLING = np.array([np.ones(_MOST), 1.0 / (_POWERS + 1), 1.0 / ((_POWERS + 1) * (_POWERS + 2))])
"""Factors of the powers after zero, one and two integrations."""


def _parts(command: MotionCommand, before: Array, times: Array) -> _Parts:
    """Return parts of the command covered by windows from and to ascending instants (k,) [s]."""
    nodes = command.nodes_between(before[0], times[-1])
    # Beyond the nodes the command is at rest; in between, samples do not define the ends of parts.
    ends = min(before[0], nodes.min(initial=np.inf)), max(times[-1], nodes.max(initial=-np.inf))
    edges = np.unique(np.concatenate([nodes, ends]))
    place = command.place_at(edges)
    stands = place[1:] == place[:-1]
    whole = edges[1:] - edges[:-1]
    count = np.where(stands, 1, np.ceil(whole / _LONGEST_PART_S)).astype(np.int64)
    widths = whole / count
    # All parts between the edges have numbers; those are computed that a window covers.
    numbered = np.cumsum(count) - count

    def part_at(times: Array, side: Literal["left", "right"]) -> Index:
        """Return the parts that contain instants (k,) [s], at an edge the one on that side."""
        row = np.searchsorted(edges, times, side=side) - 1
        row = row.clip(0, len(whole) - 1)
        number = ((times - edges[row]) / widths[row]).astype(np.int64)
        part: Index = numbered[row] + number.clip(0, count[row] - 1)
        return part

    part = _covered(part_at(before, "right"), part_at(times, "left"))
    row = np.searchsorted(numbered, part, side="right") - 1
    start, width = edges[row] + widths[row] * (part - numbered[row]), widths[row]
    return _integrated(start, width, *_powers(command, start, width, stands[row]))


def _even_parts(command: MotionCommand, before: Array, times: Array) -> _Parts:
    """Return parts of equal width, at multiples of it, that such windows cover."""
    first = np.floor(before / PART_S).astype(np.int64)
    last = np.ceil(times / PART_S).astype(np.int64)
    part = _covered(first, last - 1)
    joints = command.joints_in_parts(part)
    origin = joints[0, 0]
    powers = np.zeros((len(part), _MOST, len(origin)))
    powers[:, : len(PLACES)] = np.einsum("pg,mgn->mpn", _GAUSS[len(PLACES)][1], joints - origin)
    width = np.full(len(part), PART_S)
    return _integrated(part * width, width, origin, powers)


def _covered(first: Index, last: Index) -> Index:
    """Return all parts from the first (k,) to the last (k,) of windows, once each, ascending.

    Windows begin and end in the same order.
    """
    new = first.copy()
    np.maximum(new[1:], last[:-1] + 1, out=new[1:])
    row, number = repeated(np.maximum(last - new + 1, 0))
    return new[row] + number


def _integrated(start: Array, width: Array, origin: Array, powers: Array) -> _Parts:
    """Return parts with the integrals over all parts before them."""
    once, twice = np.einsum("op,mpn->omn", _FALLING[1:], powers)
    integral = _sums_before(width[:, None] * once)
    double = _sums_before(width[:, None] * (integral + width[:, None] * twice))
    return _Parts(start, width, origin, powers, np.stack([integral, double]))


def _powers(
    command: MotionCommand, start: Array, width: Array, stationary: Mask
) -> tuple[Array, Array]:
    """Return origin (n,) and polynomials (m, _MOST, n) of parts (m,) of the command."""
    kinds: list[tuple[int, Index]] = [(1, np.flatnonzero(stationary))]
    longer = np.full(len(start), False)
    for count, least in _PLACES:
        of_kind = (width > least) & ~longer
        longer |= of_kind
        kinds.append((count, np.flatnonzero(of_kind & ~stationary)))
    instants = [
        (start[at, None] + width[at, None] * _GAUSS[count][0]).ravel() for count, at in kinds
    ]
    joints = command.joints_at(np.concatenate(instants))
    origin, begin = joints[0], 0
    powers = np.zeros((len(start), _MOST, len(origin)))
    for count, at in kinds:
        values = (joints[begin : begin + count * len(at)] - origin).reshape(
            len(at), count, len(origin)
        )
        begin += count * len(at)
        first = values[:, :1]
        powers[at, :count] = np.einsum("pg,mgn->mpn", _GAUSS[count][1], values - first)
        powers[at, 0] += first[:, 0]
    return origin, powers


def _gauss(count: int) -> tuple[Array, Array]:
    """Return Gauss points as shares of a part, and the matrix from values there to powers."""
    places = 0.5 * (np.polynomial.legendre.leggauss(count)[0] + 1.0)
    return places, np.asarray(np.linalg.inv(places[:, None] ** np.arange(count)), np.float64)


_GAUSS = {count: _gauss(count) for count in (1, 2, 3, 5)}


def _sums_before(parts: Array) -> Array:
    """Return the sum of all parts (m, n) before each."""
    return np.concatenate([np.zeros_like(parts[:1]), np.cumsum(parts[:-1], axis=0)])
