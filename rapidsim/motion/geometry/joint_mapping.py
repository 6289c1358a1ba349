r"""Mapping from curves to joints: joints and their derivatives from the motion of the TCP.

The flange pose follows from the curve through whatever holds or carries tool and work object:

    base_from_flange = base_from_curve @ curve_from_tcp @ tcp_from_flange            tool held
    base_from_flange = base_from_tool @ object_from_tcp^-1 @ object_from_flange     stationary tool

if tracks, positioners and robots that carry a work object move base_from_curve and base_from_tool.
With SingArea \Wrist the wrist axes are interpolated instead, and the first three axes keep the TCP
on its curve. With CirPathMode \Wrist45 and the like, two wrist axes guide the tool along an arc
(`wrist_pair`).

Joint vectors here are wide: the n joints of the arm, then e external axes. The axes of robots that
carry a work object (`CarrierRobot`) count as external axes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter

import numpy as np
import numpy.typing as npt

from rapidsim.frames.moving_frames import ExternalCourse, Twists, carried
from rapidsim.frames.rotation_vectors import cross, rotate
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.derived_values import derived_value
from rapidsim.motion.geometry.segment_rows import branches_of, of_each
from rapidsim.motion.geometry.segments import Carrier, CarrierRobot, Geometry, Segment
from rapidsim.motion.geometry.wrist_pair import WristPairs, wrist_pairs_of
from rapidsim.motion.kinematics.arm import Kinematics, Mask
from rapidsim.repeated_rows import shared_row

Index = npt.NDArray[np.int64]

_MAIN_AXES = 3
_SINGULAR_DETERMINANT = 1e-8
_SINGULAR_VALUE = 1e-7
_NEWTON_STEPS = 12
_ON_THE_CURVE = 1e-9
_BY_MAIN_AXES, _BY_PAIR = -1, -2


@dataclass(frozen=True, eq=False)
class JointMapper:
    """Relation of TCP poses on curves to flange poses, one row per curve."""

    kinematics: Kinematics
    branch: Index
    """Shape (m,)."""
    tcp_from_flange: Transform
    """Shape (m,)."""
    carriers: tuple[Carrier | None, ...] = ()
    """One per curve, None for a curve without carrier; empty if no curve has one."""
    turned_rows: Mask | None = None
    """Shape (m,): the curves whose wrist axes are interpolated; None if there are none."""
    wrist_rate: Array | None = None
    """Shape (m, n - 3): wrist joints per unit of the parameter of those curves [rad/m]."""
    pairs: WristPairs | None = None
    """Wrist axes that guide the tool along arcs; None if there are none."""

    @cached_property
    def wrist_rows(self) -> Mask:
        """Shape (m,): curves on which the wrist axes are interpolated."""
        if self.turned_rows is None:
            return np.zeros(len(self.branch), dtype=bool)
        return self.turned_rows

    @cached_property
    def pair_rows(self) -> Mask:
        """Shape (m,): arcs along which two wrist axes guide the tool."""
        if self.pairs is None:
            return np.zeros(len(self.branch), dtype=bool)
        led: Mask = self.pairs.axes[:, 0] >= 0
        return led

    @cached_property
    def carried_rows(self) -> Mask:
        """Shape (m,): curves with a carrier."""
        carriers = self.carriers or (None,) * len(self.branch)
        return np.array([carrier is not None for carrier in carriers], dtype=bool)

    def joints(self, motion: Twists, row: Index, near: Array) -> tuple[Array, Mask]:
        """Return joints (k, n + e) for TCP poses (k,) on curves (k,), and a mask of reachable rows.

        Unreachable rows contain `near` (k, n + e). External axes and interpolated wrist axes are
        copied from `near`. On arcs with a wrist pair only the position of the TCP is used.
        """
        n = self.kinematics.joint_count
        base_from_flange = self.base_from_flange(motion, row, near)
        joints = near.copy()
        exists = np.zeros(len(row), dtype=bool)
        branches = np.where(self.wrist_rows[row], _BY_MAIN_AXES, self.branch[row])
        branches = np.where(self.pair_rows[row], _BY_PAIR, branches)
        for branch in np.unique(branches):
            at = np.flatnonzero(branches == branch)
            if branch < 0:
                tcp = (base_from_flange[at] @ self._flange_from_tcp[row[at]]).translation
                reach = self._reach_with_wrist if branch == _BY_MAIN_AXES else self._reach_with_pair
                joints[at, :n], exists[at] = reach(tcp, row[at], near[at, :n])
                continue
            followed = self.kinematics.inverse_on_branch(
                base_from_flange[at], int(branch), near[at, :n]
            )
            reached = at[followed.exists]
            joints[reached, :n] = followed.joints[followed.exists]
            exists[reached] = True
        return joints, exists

    def rates(
        self, motion: Twists, row: Index, course: ExternalCourse, near: Array
    ) -> tuple[Array, Array, Array]:
        """Return joints (k, n + e) for a TCP motion (k,) on curves (k,), and their derivatives."""
        n = self.kinematics.joint_count
        joints, _ = self.joints(motion, row, near)
        first, second = np.empty_like(joints), np.empty_like(joints)
        first[:, n:], second[:, n:] = course.first, course.second
        flange = self._flange(motion, row, course)
        wrist, pair = self.wrist_rows[row], self.pair_rows[row]
        for at, solve in (
            (np.flatnonzero(~(wrist | pair)), self._rates_of_all),
            (np.flatnonzero(wrist), self._rates_with_wrist),
            (np.flatnonzero(pair), self._rates_with_pair),
        ):
            if len(at):
                first[at, :n], second[at, :n] = solve(joints[at, :n], flange[at], row[at])
        return joints, first, second

    def base_from_flange(self, motion: Twists, row: Index, joints: Array) -> Transform:
        """Return flange poses (k,) for TCP poses on curves.

        Only the external axes of `joints` (k, n + e) are used.
        """
        if not self.carried_rows[row].any():
            return motion.base_from_tcp @ self.tcp_from_flange[row]
        course = _still(joints[:, self.kinematics.joint_count :])
        return self._flange(motion, row, course).base_from_tcp

    def base_from_tcp(self, joints: Array, row: Index) -> Transform:
        """Return TCP poses in base for joints (k, n + e) on curves (k,)."""
        n = self.kinematics.joint_count
        base_from_tcp = self.kinematics.forward(joints[:, :n]) @ self._flange_from_tcp[row]
        for i in np.unique(row[self.carried_rows[row]]):
            carrier = self.carriers[i]
            if carrier is not None and carrier.base_from_tool is not None:
                at = np.flatnonzero(row == i)
                tool = _base_from_curve(carrier, _still(joints[at, n:])).base_from_tcp
                base_from_tcp.rotation[at] = tool.rotation
                base_from_tcp.translation[at] = tool.translation
        return base_from_tcp

    def curve_from_tcp(self, joints: Array, row: Index) -> Transform:
        """Return TCP poses on curves for joints (k, n + e); in base if nothing is carried."""
        if not self.carried_rows[row].any():
            return (
                self.kinematics.forward(joints[:, : self.kinematics.joint_count])
                @ (self._flange_from_tcp[row])
            )
        return self.curve_motion(joints, np.zeros_like(joints), row).base_from_tcp

    def curve_motion(self, joints: Array, first: Array, row: Index) -> Twists:
        """Return the TCP motion on curves from joints and rates (k, n + e), without accelerations.

        If a stationary robot holds the tool, this is the motion in base.
        """
        n = self.kinematics.joint_count
        flange = self.kinematics.forward(joints[:, :n])
        twist = np.einsum("kij,kj->ki", self.kinematics.jacobian(joints[:, :n]), first[:, :n])
        still = np.zeros((len(joints), 3))
        in_base = Twists(
            flange.translation, flange.rotation, twist[:, :3], twist[:, 3:], still, still
        ).before(self._flange_from_tcp[row])
        for i in np.unique(row[self.carried_rows[row]]):
            carrier = self.carriers[i]
            assert carrier is not None
            at = np.flatnonzero(row == i)
            course = ExternalCourse(joints[at, n:], first[at, n:], np.zeros_like(first[at, n:]))
            on_curve = _base_from_curve(carrier, course).inverse() @ in_base[at]
            in_base.put(at, on_curve if carrier.base_from_tool is None else on_curve.inverse())
        return in_base

    @derived_value
    def _flange_from_tcp(self) -> Transform:
        return self.tcp_from_flange.inverse()

    def _flange(self, motion: Twists, row: Index, course: ExternalCourse) -> Twists:
        """Return flange motions in base for TCP motions (k,) on curves (k,)."""
        rows = np.unique(row[self.carried_rows[row]])
        if len(rows):
            motion = motion[:]
        for i in rows:
            carrier = self.carriers[i]
            assert carrier is not None
            at = np.flatnonzero(row == i)
            part = motion[at] if carrier.base_from_tool is None else motion[at].inverse()
            of_curve = ExternalCourse(*(values[at] for values in course))
            motion.put(at, _base_from_curve(carrier, of_curve) @ part)
        return motion.before(self.tcp_from_flange[row])

    def _rates_of_all(self, joints: Array, flange: Twists, row: Index) -> tuple[Array, Array]:
        """Return joint rates and accelerations (k, n) for the motion of the whole pose."""
        del row
        twist = np.concatenate([flange.velocity, flange.turning], axis=-1)
        change = np.concatenate([flange.acceleration, flange.turning_change], axis=-1)
        jacobian = self.kinematics.jacobian(joints)
        first = _solve(jacobian, twist)
        return first, _solve(jacobian, change - _drift(self.kinematics, joints, jacobian, first))

    def _rates_with_wrist(self, joints: Array, flange: Twists, row: Index) -> tuple[Array, Array]:
        """Return joint rates and accelerations (k, n) for a TCP position and wrist rotation."""
        assert self.wrist_rate is not None
        tcp = flange.before(self._flange_from_tcp[row])
        jacobian = self._point_jacobian(joints, row)
        first = np.zeros_like(joints)
        first[:, _MAIN_AXES:] = self.wrist_rate[row]
        by_wrist = np.einsum("kij,kj->ki", jacobian, first)
        main = jacobian[..., :_MAIN_AXES]
        first[:, :_MAIN_AXES] = _solve(main, tcp.velocity - by_wrist)
        step = 1e-6 / np.maximum(np.abs(first).max(axis=-1), 1e-9)[:, None]
        ahead = self._point_jacobian(joints + step * first, row)
        drift = np.einsum("kij,kj->ki", (ahead - jacobian) / step[..., None], first)
        second = np.zeros_like(joints)
        second[:, :_MAIN_AXES] = _solve(main, tcp.acceleration - drift)
        return first, second

    def _rates_with_pair(self, joints: Array, flange: Twists, row: Index) -> tuple[Array, Array]:
        """Return joint rates and accelerations (k, n) on arcs with a wrist pair."""
        assert self.pairs is not None
        on_arc = flange.before(self._flange_from_tcp[row])
        return self.pairs.rates(joints, row, on_arc.position, on_arc.velocity, on_arc.acceleration)

    def _reach_with_wrist(self, tcp: Array, row: Index, near: Array) -> tuple[Array, Mask]:
        """Return joints (k, n) that move the TCP to (k, 3) with the wrist as in `near` (k, n)."""
        joints = near.copy()
        tcp_in_flange = self._flange_from_tcp.translation[row]
        for _ in range(_NEWTON_STEPS):
            miss = tcp - self.kinematics.forward(joints).apply(tcp_in_flange)
            if np.abs(miss).max(initial=0.0) < 1e-3 * _ON_THE_CURVE:
                break
            main = self._point_jacobian(joints, row)[..., :_MAIN_AXES]
            joints[:, :_MAIN_AXES] += np.clip(_solve(main, miss), -0.5, 0.5)
        miss = tcp - self.kinematics.forward(joints).apply(tcp_in_flange)
        there = np.linalg.norm(miss, axis=-1) < _ON_THE_CURVE
        return np.where(there[:, None], joints, near), there

    def _reach_with_pair(self, tcp: Array, row: Index, near: Array) -> tuple[Array, Mask]:
        """Return joints (k, n) that aim the z axis of the tool at points (k, 3)."""
        assert self.pairs is not None
        return self.pairs.joints(tcp, row, near)

    def _point_jacobian(self, joints: Array, row: Index) -> Array:
        """Return the TCP velocity per joint speed, (k, 3, n) [m/rad], in base."""
        jacobian = self.kinematics.jacobian(joints)
        rotation = self.kinematics.forward(joints).rotation
        lever = rotate(rotation, self._flange_from_tcp.translation[row])
        turning = np.swapaxes(jacobian[..., 3:, :], -1, -2)  # (k, n, 3)
        swing = cross(turning, np.broadcast_to(lever[:, None], turning.shape))
        point: Array = jacobian[..., :3, :] + np.swapaxes(swing, -1, -2)
        return point


def arms_of(
    segments: Sequence[Segment], kinematics: Kinematics, joint_travel: Array, length: Array
) -> JointMapper:
    """Return the relation of curves to flange poses for segments.

    Args:
        segments: One per curve.
        kinematics: The arm.
        joint_travel: End joints minus start joints (m, n + e) [rad].
        length: Ranges of the curves' parameter (m,) [m].
    """
    carriers = tuple(of_each(segments, attrgetter("carrier")))
    turned = of_each(segments, lambda s: s.wrist_in_joints and s.geometry is not Geometry.JOINT)
    n = kinematics.joint_count
    wrist_rate = joint_travel[:, _MAIN_AXES:n] / np.maximum(length, 1e-9)[:, None]
    return JointMapper(
        kinematics,
        shared_row(branches_of(segments)),
        Transform(
            shared_row(of_each(segments, attrgetter("tcp_from_flange.rotation"))),
            shared_row(of_each(segments, attrgetter("tcp_from_flange.translation"))),
        ),
        carriers if any(carriers) else (),
        turned if turned.any() else None,
        wrist_rate if turned.any() else None,
        wrist_pairs_of(segments, kinematics),
    )


def _base_from_curve(carrier: Carrier, course: ExternalCourse) -> Twists:
    """Return the motion of curves, or of a stationary tool, in robot base for a course (k, e)."""
    frame = carried(carrier.base_screws, course).inverse()
    if carrier.base_from_tool is not None:
        return frame.before(carrier.base_from_tool)
    if carrier.robot is not None:
        return frame @ _base_from_flange_of(carrier.robot, course)
    return frame @ carried(carrier.object_screws, course)


def _base_from_flange_of(leader: CarrierRobot, course: ExternalCourse) -> Twists:
    """Return the flange motion of a robot that carries a work object, for axes (k, e)."""
    own = ExternalCourse(*(values[:, leader.column :] for values in course))
    kinematics = leader.kinematics
    joints, first, second = (values[:, : kinematics.joint_count] for values in own)
    flange = kinematics.forward(joints)
    twist, change = np.zeros((2, len(joints), 6))
    if first.any() or second.any():
        jacobian = kinematics.jacobian(joints)
        twist = np.einsum("kij,kj->ki", jacobian, first)
        change = np.einsum("kij,kj->ki", jacobian, second)
        change += _drift(kinematics, joints, jacobian, first)
    moved = Twists(
        flange.translation,
        flange.rotation,
        twist[:, :3],
        twist[:, 3:],
        change[:, :3],
        change[:, 3:],
    )
    return carried(leader.base_screws, own).before(leader.base_from_carrier) @ moved


def _drift(kinematics: Kinematics, joints: Array, jacobian: Array, first: Array) -> Array:
    """Return J' q' (k, 6), the change of the Jacobian along the motion times joint rates.

    The finite difference uses a step of 1e-6 rad: its truncation and rounding errors are far below
    the resolution of timing.
    """
    step = 1e-6 / np.maximum(np.abs(first).max(axis=-1), 1e-9)[:, None]
    ahead = kinematics.jacobian(joints + step * first)
    drift: Array = np.einsum("kij,kj->ki", (ahead - jacobian) / step[..., None], first)
    return drift


def _still(external: Array) -> ExternalCourse:
    return ExternalCourse(external, np.zeros_like(external), np.zeros_like(external))


def _solve(jacobian: Array, twist: Array) -> Array:
    """Return joint rates (k, n) for twists (k, r); of least norm where the arm is singular."""
    rates = np.empty((len(twist), jacobian.shape[-1]))
    regular = np.zeros(len(twist), dtype=bool)
    if jacobian.shape[-1] == jacobian.shape[-2]:
        regular = np.abs(np.linalg.det(jacobian)) > _SINGULAR_DETERMINANT
        rates[regular] = np.linalg.solve(jacobian[regular], twist[regular][..., None])[..., 0]
    if not regular.all():
        inverse = np.linalg.pinv(jacobian[~regular], rcond=_SINGULAR_VALUE)
        rates[~regular] = np.einsum("kij,kj->ki", inverse, twist[~regular])
    return rates
