"""Mapping of the curves of a block and its corners to one path parameter s.

s runs over the programmed curves one after the other, so the middle of a corner path has the s of
the programmed point. Between breakpoints (zone edges and middles) the path is one smooth piece.
Derivatives jump at breakpoints, so points are always passed with their piece.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from rapidsim.frames.moving_frames import ExternalCourse, Twists
from rapidsim.frames.rotation_vectors import cross, rotate
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.blend_shape import CODES, KNEE, MEASURED, PARABOLA, corner_sides
from rapidsim.motion.geometry.blends import Corners
from rapidsim.motion.geometry.curves import Curves, Index
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.model import BlendShape
from rapidsim.repeated_rows import shared_row
from rapidsim.values import value_class

_SLIVER = 1e-12
_STRAIGHT = 1e-3
"""Deflection [rad] below which a corner has no knees: the bend then takes at most a hundredth of
what the axes can do."""


class Sides(NamedTuple):
    """Points on the two curves that a corner path blends, and their rates.

    `before` and `after` contain x, dx/ds and d2x/ds2, shape (k,) each.
    """

    before: tuple[Array, Array, Array]
    after: tuple[Array, Array, Array]


class CarrierAxes(Protocol):
    """Axes of robots that carry work objects, along the path of a robot that works on them."""

    def course(self, s: Array, inside: Array) -> ExternalCourse:
        """Return those axes (k, l) at s (k,) [m] on the piece that contains `inside` (k,)."""
        ...


@value_class(frozen=True, slots=True, eq=False)
class PathParameterisation:
    """Pieces of a path of m curves; -1 means no corner."""

    curves: Curves
    corners: Corners
    corner_shape: BlendShape
    places: Array
    """Shape (m + 1,): s at the start of each curve, and the length of the path."""
    bounds: Array
    """Shape (p + 1,): s of the breakpoints, increasing."""
    row: Index
    """Shape (p,): index of the curve of each piece."""
    position_corner: Index
    orientation_corner: Index
    joint_corner: Index
    carrier_axes: CarrierAxes | None = None
    """Source of the last external axes; None if no other robot carries a work object."""

    @property
    def shape(self) -> int:
        """Blend shape of corners for position and in joint space; see `blend_shape`."""
        return CODES[self.corner_shape]

    @property
    def turn_shape(self) -> int:
        """Blend shape of corners for orientation and external axes.

        Where the position has the measured shape, logs show a parabola, within 0.1 mdeg.
        """
        return PARABOLA if self.shape == MEASURED else self.shape

    @property
    def in_corner(self) -> Index:
        """Corner (p,) of any kind that contains each piece, or -1."""
        return np.maximum(
            np.maximum(self.position_corner, self.orientation_corner), self.joint_corner
        )

    def piece_at(self, s: Array) -> Index:
        """Return the piece (k,) that contains each s (k,); at a breakpoint that starting there."""
        piece = np.searchsorted(self.bounds, s, side="right") - 1
        return np.clip(piece, 0, len(self.row) - 1).astype(np.int64)

    def sides(self, corner: Index, radius: Array, s: Array, shape: int) -> Sides:
        """Return the points on the curves before and after for s (k,) within corners (k,)."""
        past = s - self.places[corner + 1]
        return Sides(*corner_sides(shape, past, radius, self.curves.length[corner]))

    def motion(self, s: Array, piece: Index) -> Twists:
        """Return the TCP motion at s (k,) on pieces (k,) defined in Cartesian space.

        In corners defined in joint space this is the programmed curve.
        """
        row = self.row[piece]
        x = np.clip(s - self.places[row], 0.0, self.curves.length[row])
        motion = self.curves.at(row, x)
        corner = self.position_corner[piece]
        cut = np.flatnonzero(corner >= 0)
        if len(cut):
            self._cut_position(motion, cut, corner[cut], s[cut])
        corner = self.orientation_corner[piece]
        cut = np.flatnonzero(corner >= 0)
        if len(cut):
            self._cut_orientation(motion, cut, corner[cut], s[cut])
        return motion

    def speeds(self, s: Array, piece: Index) -> Array:
        """Return the length (k, g) of the velocity of `motion` at places (k, g) of pieces (k,)."""
        row, corner = self.row[piece], self.position_corner[piece]
        x = np.clip(s - self.places[row][:, None], 0.0, self.curves.length[row][:, None])
        speed = np.empty_like(s)
        speed[:] = np.linalg.norm(self.curves.velocity(row, x), axis=-1)
        cut = np.flatnonzero(corner >= 0)
        if len(cut):
            at = corner[cut]
            radius = self.corners.radius[at][:, None]
            before, after = self.sides(at[:, None], radius, s[cut], self.shape)
            into = np.moveaxis(self.curves.velocity(at, before[0]), -1, 0)
            out = np.moveaxis(self.curves.velocity(at + 1, after[0]), -1, 0)
            # Axis by axis, for rows of three numbers cost more.
            both = zip(into, out, strict=True)
            speed[cut] = np.sqrt(sum((a * before[1] + b * after[1]) ** 2 for a, b in both))
        return speed

    def course(self, s: Array, piece: Index) -> ExternalCourse:
        """Return external axes (k, e) at s (k,) on pieces (k,) defined in Cartesian space."""
        row, count = self.row[piece], self.curves.external.shape[1]
        if not count:
            nothing = np.zeros((len(s), 0))
            return ExternalCourse(nothing, nothing, nothing)
        course = self._own_course(s, piece, row, count)
        self.fill_carrier_axes(s, piece, *course)
        return course

    def fill_carrier_axes(self, s: Array, piece: Index, *columns: Array) -> None:
        """Write axes of carriers, and their derivatives, to the last columns of arrays (k, ...).

        Args:
            s: Path parameters (k,) [m].
            piece: Their pieces (k,).
            columns: Joints, and their first and second derivative, or only the first of these.
        """
        if self.carrier_axes is not None:
            inside = 0.5 * (self.bounds[piece] + self.bounds[piece + 1])
            for values, led in zip(columns, self.carrier_axes.course(s, inside), strict=False):
                values[:, values.shape[1] - led.shape[1] :] = led

    def _own_course(self, s: Array, piece: Index, row: Index, count: int) -> ExternalCourse:
        """Return external axes (k, e), linear in s, blended in corners like the orientation."""
        start = self.curves.start_joints[:, -count:]
        rate = self.curves.joint_travel[:, -count:] / np.maximum(self.curves.length, 1e-9)[:, None]
        x = np.clip(s - self.places[row], 0.0, self.curves.length[row])[:, None]
        course = ExternalCourse(start[row] + rate[row] * x, rate[row], np.zeros((len(s), count)))
        corner = self.orientation_corner[piece]
        cut = np.flatnonzero(corner >= 0)
        if len(cut):
            at = corner[cut]
            radius = self.corners.orientation_radius[at]
            before, after = self.sides(at, radius, s[cut], self.turn_shape)
            into, out = rate[at], rate[at + 1]
            (x_in, x_in_1, x_in_2), (x_out, x_out_1, x_out_2) = (
                [part[:, None] for part in side] for side in (before, after)
            )
            course.value[cut] = start[at] + into * x_in + out * x_out
            course.first[cut] = into * x_in_1 + out * x_out_1
            course.second[cut] = into * x_in_2 + out * x_out_2
        return course

    def _cut_position(self, motion: Twists, cut: Index, corner: Index, s: Array) -> None:
        before, after = self.sides(corner, self.corners.radius[corner], s, self.shape)
        into = self.curves.at(corner, before[0])
        out = self.curves.at(corner + 1, after[0])
        programmed = self.curves.start.translation[corner + 1]
        motion.position[cut] = into.position + out.position - programmed
        motion.velocity[cut] = into.velocity * before[1][:, None] + out.velocity * after[1][:, None]
        motion.acceleration[cut] = (
            into.acceleration * before[1][:, None] ** 2
            + into.velocity * before[2][:, None]
            + out.acceleration * after[1][:, None] ** 2
            + out.velocity * after[2][:, None]
        )

    def _cut_orientation(self, motion: Twists, cut: Index, corner: Index, s: Array) -> None:
        radius = self.corners.orientation_radius[corner]
        before, after = self.sides(corner, radius, s, self.turn_shape)
        into = self.curves.at(corner, before[0])
        out = self.curves.at(corner + 1, after[0])
        programmed = self.curves.start.rotation[corner + 1]
        # Rotation from the corner back by the curve before, then forward by the one after.
        backwards = into.rotation @ np.swapaxes(programmed, -1, -2)
        first = into.turning * before[1][:, None]
        second = rotate(backwards, out.turning) * after[1][:, None]
        motion.rotation[cut] = backwards @ out.rotation
        motion.turning[cut] = first + second
        motion.turning_change[cut] = (
            into.turning_change * before[1][:, None] ** 2
            + into.turning * before[2][:, None]
            + cross(first, second)
            + rotate(
                backwards,
                out.turning_change * after[1][:, None] ** 2 + out.turning * after[2][:, None],
            )
        )


def _straight_on(curves: Curves) -> Mask:
    """Mask (m - 1,) of collinear successive lines: no corner path bends between them."""
    lines = (curves.travel > 0.0) & ~curves.in_joints & ~curves.spoke.any(axis=1)
    direction = curves.chord / np.maximum(curves.travel, 1e-300)[:, None]
    off = np.abs(direction[1:] - direction[:-1]).max(axis=1)
    straight: Mask = lines[1:] & lines[:-1] & (off < _STRAIGHT)
    return straight


def layout_of(
    curves: Curves,
    corners: Corners,
    corner_shape: BlendShape,
    carrier_axes: CarrierAxes | None = None,
    further: Array | None = None,
) -> PathParameterisation:
    """Divide a sequence of curves and their corners into pieces.

    Args:
        curves: The curves.
        corners: Their corners.
        corner_shape: See `MotionModel`.
        carrier_axes: The axes of robots that carry work objects.
        further: More s [m] at which pieces end.
    """
    count = len(curves.length)
    places = np.concatenate([[0.0], np.cumsum(curves.length)])
    middles = places[1:-1]
    edges = [
        places,
        middles - corners.radius,
        middles + corners.radius,
        middles - corners.orientation_radius,
        middles + corners.orientation_radius,
    ]
    if corner_shape == "abb":
        bent = ~_straight_on(curves)
        inner = (1.0 - 2.0 * KNEE) * corners.radius[bent]
        edges += [middles[bent] - inner, middles[bent] + inner]
    if further is not None:
        edges.append(further)
    bounds = np.unique(np.clip(np.concatenate(edges), 0.0, places[-1]))
    # Zones that meet leave slivers of rounding between them.
    keep = np.concatenate([[True], np.diff(bounds) > _SLIVER * max(1.0, places[-1])])
    keep[-1] = True
    bounds = bounds[keep]
    if len(bounds) > 2 and bounds[-1] - bounds[-2] <= _SLIVER * max(1.0, places[-1]):
        bounds = np.delete(bounds, -2)
    if len(bounds) == 1:
        bounds = np.array([0.0, 0.0])
    middle = 0.5 * (bounds[:-1] + bounds[1:])
    row = np.clip(np.searchsorted(places, middle, side="right") - 1, 0, count - 1)

    def within(radius: Array, wanted: Mask) -> Index:
        """Return the corner that contains each piece, or -1."""
        corner = np.full(len(row), -1, dtype=np.int64)
        for candidate in (row - 1, row):
            valid = (candidate >= 0) & (candidate < count - 1)
            index = np.where(valid, candidate, 0)
            if count > 1:
                inside = valid & wanted[index]
                inside &= np.abs(middle - places[index + 1]) < radius[index]
                corner[inside] = index[inside]
        return corner

    cartesian = ~corners.in_joints
    moving = within(corners.radius, cartesian)
    turning = within(corners.orientation_radius, cartesian)
    return PathParameterisation(
        curves=curves,
        corners=corners,
        corner_shape=corner_shape,
        places=places,
        bounds=bounds,
        row=row.astype(np.int64),
        position_corner=moving,
        orientation_corner=moving if np.array_equal(moving, turning) else turning,
        joint_corner=shared_row(within(corners.radius, corners.in_joints)),
        carrier_axes=carrier_axes,
    )
