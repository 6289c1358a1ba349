"""Torque limits of axes 1 to 3 of an arm with an elbow, with its posture-dependent inertia.

A controller limits torques, not accelerations. Each torque is divided by its limit, so that the
range is +-1; for the wrist axes constant accelerations suffice. With q2 and q3 as ABB counts them
(lower arm upright, forearm level at 0) and phi = q2 + q3:

    tau1 = n11 q1'' + (n11,2 q2' + n11,3 q3') q1'
    tau2 = n22 q2'' + n23 q3'' + h (2 q2' q3' + q3'^2) - n11,2 q1'^2 / 2
    tau3 = n33 q3'' + kappa (n23 q2'' - h q2'^2) - n11,3 q1'^2 / 2

    n11 = i1 + rod [(a1 + c2 s2 / 2)^2 + (c2 s2)^2 / 12] + point r^2
    r = a1 + c2 s2 + x cos(phi) + z sin(phi)
    n22 = c + d cos(q3 - delta),   n23 = e + (d / 2) cos(q3 - delta),   h = -(d / 2) sin(q3 - delta)

Friction is neglected, and so is gravity, which takes 14 % of axis 3 of a large arm. On arms whose
drives are weak against their weight it counts (`Gravity`): an arm that lifts with 1 - g of a torque
brakes with 1 + g, which together last as long as 1 - g^2 both ways. That mean is the limit here.

Source: published tables of peak accelerations of two arms over their working range, which this law
reproduces within 6 and 9 %; on logs of straight moves both torques stay on plateaus of 0.95 to
1.05.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.values import value_class

_POINT_OF_RATED_LOAD = 1.3
"""Effective mass of the forearm in units of the rated payload: 0.9 to 1.8. Assumed."""

_LEAST_REMAINING = 0.1
"""Share of a torque that always remains beside gravity."""


@value_class(frozen=True, slots=True)
class Torques:
    """Constants of the law above for one arm, in s2/rad; `rod` and `point` per m2."""

    i1: float
    """Motors and column."""
    rod: float
    """Lower arm, as a rod."""
    point: float
    """Forearm and wrist, as a point."""
    x: float
    """Distance [m] of that point ahead of axis 3, along the forearm."""
    z: float
    """Height [m] of that point above axis 3."""
    c: float
    d: float
    delta: float
    """[rad]"""
    e: float
    kappa: float
    """Limit of axis 2 over limit of axis 3."""
    n33: float
    wrist: tuple[float, float, float]
    """Accelerations of axes 4 to 6 [rad/s2]."""
    wrist_in_zones: tuple[float, float] | None = None
    """Behaviour of the wrist in zones according to logs: the share of its accelerations in a narrow
    zone, as a factor on that of the main axes (`MotionConstants.zone_share`), and the number of
    cycles whose travel widens the zone (`MotionModel.zone_cycles`). None: as for the main axes."""


@value_class(frozen=True, slots=True)
class Gravity:
    """Shares of the torques that hold the arm against gravity."""

    lower: float
    """Share of axis 2 for the level lower arm with the elbow at its end."""
    fore: float
    """Share of axis 3 for the level forearm."""
    load: float
    """Share of axis 2 for the rated payload [1/m], by its horizontal distance."""


class Dynamics(Protocol):
    """Dynamics of an arm in terms of its torques."""

    def rows(self, stance: Array, first: Array, second: Array, load: Array) -> tuple[Array, Array]:
        """Return shares of the torques of axes 1 to 3 per path acceleration and squared path speed.

        Args:
            stance: Shape (k, 4); see `PathRates`.
            first: First derivatives of the joints (k, 3) along the path [rad/m].
            second: Second derivatives (k, 3) [rad/m2].
            load: Load at the wrist (k,), as a share of the rated payload.

        Returns:
            Slope (k, 3) [s2/m] and bend (k, 3) [s2/m2].
        """
        ...

    def shares(self, stance: Array, rates: Array, changes: Array, load: Array) -> Array:
        """Torques (k, 3), divided by their limits, for joint rates and accelerations (k, 3)."""
        ...

    @property
    def least_accelerations(self) -> tuple[float, float, float]:
        """Accelerations [rad/s2] of axes 1 to 3, each alone, in the worst (stretched) posture."""
        ...

    @property
    def torque_axes(self) -> int:
        """Number of axes that torques limit; the others up to axis 3 have accelerations."""
        return 3

    @property
    def wrist(self) -> tuple[float, ...]:
        """Accelerations [rad/s2] of the axes after the third."""
        ...

    @property
    def wrist_in_zones(self) -> tuple[float, float] | None:
        """See `Torques.wrist_in_zones`."""
        return None


class _Inertia(NamedTuple):
    """Terms of the law above that depend on the posture of the arm, columns (k,)."""

    n11: Array
    n11_2: Array
    n11_3: Array
    n22: Array
    n23: Array
    n33: Array
    h: Array


@value_class(frozen=True, slots=True)
class ElbowDynamics(Dynamics):
    """Dynamics of an arm whose axes 2 and 3 are parallel, across axis 1."""

    torques: Torques
    geometry: OpwGeometry
    """Lengths of the arm; of arms without a spherical wrist, those up to axis 5."""
    gravity: Gravity | None = None
    """None to neglect it."""

    def rows(self, stance: Array, first: Array, second: Array, load: Array) -> tuple[Array, Array]:
        """Slope and bend (k, 3); see `Dynamics`."""
        inertia = self._inertia(stance, load)
        slope, bend = self._against(inertia, first), self._against(inertia, second)
        bend += self._of_speeds(inertia, first)
        if self.gravity is None:
            return slope, bend
        remaining = self._remaining(self.gravity, stance, load)
        return slope / remaining, bend / remaining

    def shares(self, stance: Array, rates: Array, changes: Array, load: Array) -> Array:
        """Shares of the torques (k, 3); see `Dynamics`."""
        inertia = self._inertia(stance, load)
        shares = self._against(inertia, changes) + self._of_speeds(inertia, rates)
        if self.gravity is None:
            return shares
        return shares / self._remaining(self.gravity, stance, load)

    def _remaining(self, gravity: Gravity, stance: Array, load: Array) -> Array:
        """Return the shares (k, 3) of the torques that accelerate, both ways on average."""
        t, g = self.torques, self.geometry
        s2, _, cos_phi, fore_up = stance.T
        sin_phi = -fore_up
        wrist = load * (g.c3 * cos_phi - g.a2 * sin_phi)
        level = (t.x * cos_phi + t.z * sin_phi) / np.hypot(t.x, t.z)
        third = gravity.fore * level + t.kappa * gravity.load * wrist
        second = gravity.lower * s2 + third / t.kappa + gravity.load * load * (g.a1 + g.c2 * s2)
        remaining: Array = np.ones((len(stance), 3))
        remaining[:, 1], remaining[:, 2] = 1.0 - second**2, 1.0 - third**2
        return np.maximum(remaining, _LEAST_REMAINING)

    def _inertia(self, stance: Array, load: Array) -> _Inertia:
        t, g = self.torques, self.geometry
        s2, c2, s23, c23 = stance.T
        # In the formulas, the angle of the forearm is measured from vertical.
        cos_phi, sin_phi = s23, -c23
        lean = s23 * c2 - c23 * s2, c23 * c2 + s23 * s2  # sine and cosine of theta3 = q3 + 90 deg
        sin_3, cos_3 = -lean[1], lean[0]
        p = load / _POINT_OF_RATED_LOAD

        lower = g.c2 * s2
        lower_2 = g.c2 * c2
        r = g.a1 + lower + t.x * cos_phi + t.z * sin_phi
        r_3 = t.z * cos_phi - t.x * sin_phi
        w = g.a1 + lower + g.c3 * cos_phi - g.a2 * sin_phi
        w_3 = -g.a2 * cos_phi - g.c3 * sin_phi
        near = g.a1 + 0.5 * lower
        n11 = t.i1 + t.rod * (near**2 + lower**2 / 12.0) + t.point * (r**2 + p * w**2)
        n11_3 = 2.0 * t.point * (r * r_3 + p * w * w_3)
        n11_2 = (
            t.rod * lower_2 * (near + lower / 6.0) + 2.0 * t.point * lower_2 * (r + p * w) + n11_3
        )

        sin_d, cos_d = np.sin(t.delta), np.cos(t.delta)
        cosine, sine = cos_3 * cos_d + sin_3 * sin_d, sin_3 * cos_d - cos_3 * sin_d
        k = p * 0.5 * t.d / (g.c2 * np.hypot(t.x, t.z))
        across = g.c2 * (-g.c3 * sin_3 - g.a2 * cos_3)
        across_3 = g.c2 * (-g.c3 * cos_3 + g.a2 * sin_3)
        w2 = g.c3**2 + g.a2**2
        n22 = t.c + t.d * cosine + k * (g.c2**2 + w2 + 2.0 * across)
        n23 = t.e + 0.5 * t.d * cosine + k * (w2 + across)
        h = -0.5 * t.d * sine + k * across_3
        n33 = t.n33 + t.kappa * k * w2
        return _Inertia(n11, n11_2, n11_3, n22, n23, n33, h)

    def _against(self, inertia: _Inertia, changes: Array) -> Array:
        """Return torques (k, 3) due to joint accelerations (k, 3)."""
        n = inertia
        e1, e2, e3 = self._of_formulas(changes)
        coupled = n.n33 * e3 + self.torques.kappa * n.n23 * e2
        return np.stack([n.n11 * e1, n.n22 * e2 + n.n23 * e3, coupled], axis=-1)

    def _of_speeds(self, inertia: _Inertia, rates: Array) -> Array:
        """Return torques (k, 3) due to products of joint rates (k, 3)."""
        n = inertia
        q1, q2, q3 = self._of_formulas(rates)
        square = 0.5 * q1 * q1
        return np.stack(
            [
                (n.n11_2 * q2 + n.n11_3 * q3) * q1,
                n.h * (2.0 * q2 + q3) * q3 - n.n11_2 * square,
                -self.torques.kappa * n.h * q2 * q2 - n.n11_3 * square,
            ],
            axis=-1,
        )

    def _of_formulas(self, rates: Array) -> tuple[Array, Array, Array]:
        """Convert rates of joints 1 to 3 (k, 3) to rates of the formulas' angles."""
        signs, coupling = self.geometry.signs, self.geometry.coupling
        j1, j2, j3 = rates.T
        return signs[0] * j1, signs[1] * j2, signs[2] * (j3 + coupling * j2)

    @property
    def wrist(self) -> tuple[float, ...]:
        """Accelerations of the axes after the third."""
        return self.torques.wrist

    @property
    def wrist_in_zones(self) -> tuple[float, float] | None:
        """See `Torques.wrist_in_zones`."""
        return self.torques.wrist_in_zones

    @property
    def least_accelerations(self) -> tuple[float, float, float]:
        """Accelerations of axes 1 to 3 of the stretched arm."""
        t, g = self.torques, self.geometry
        r = g.a1 + g.c2 + t.x
        n11 = t.i1 + t.rod * ((g.a1 + 0.5 * g.c2) ** 2 + g.c2**2 / 12.0) + t.point * r**2
        second, third = 1.0, 1.0
        if self.gravity is not None:
            level = np.array([[1.0, 0.0, 1.0, 0.0]])
            _, second, third = self._remaining(self.gravity, level, np.zeros(1))[0].tolist()
        return 1.0 / n11, second / (t.c + t.d), third / t.n33
