"""Torques of the two parallel axes of a SCARA, with the inertia of both links.

With both angles from the stretched arm, and torques divided by their limits T:

    tau1 = [H11 q1'' + H12 q2'' - B sin q2 (2 q1' + q2') q2'] / T1
    tau2 = [H12 q1'' + H22 q2'' + B sin q2 q1'^2] / T2

    H11 = i1 + I1 + m1 c1^2 + (m2 + mL) a1^2 + E + 2 B cos q2
    H12 = E + B cos q2,   H22 = i2 + E
    E = I2 + m2 c2^2 + mL a2^2,   B = a1 (m2 c2 + mL a2)

The axes are vertical, so gravity does not count. Axes 3 and 4 have constant accelerations.

Source: masses and their distribution by drawings of a similar arm, at one density; T1 is fitted to
the published picking cycle of an IRB 910SC-3/0.65. T2 and rotors are assumed; the cycle changes by
nothing with T2 from 0.67 to 1.56 times its value. Two shorter arms were not fitted.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.arm import METRES_PER_UNIT
from rapidsim.motion.kinematics.closed_form.scara import ScaraGeometry
from rapidsim.motion.robot.dynamics import Dynamics
from rapidsim.values import value_class

_ROTOR_1, _ROTOR_2 = 0.5, 0.16
"""Reflected inertias of the rotors [kg m2]."""
_LIMIT_1, _LIMIT_2 = 380.0, 171.0
"""Limits T1 and T2 [Nm]; only their ratios to the masses count."""
_LIFT = 50.0
"""Acceleration of axis 3 [m/s2]."""
_MASS_2 = 50.16
"""Mass of link 2 by its length [kg/m]; it holds the motors of axes 2 to 4."""


@value_class(frozen=True, slots=True)
class Links:
    """Masses [kg], centres [m] from their axis, and inertias [kg m2] about it, of both links."""

    mass_1: float
    centre_1: float
    inertia_1: float
    mass_2: float
    centre_2: float
    inertia_2: float


def links_by_lengths(geometry: ScaraGeometry) -> Links:
    """Return the links of an arm by its lengths."""
    mass, gyration = 1.97 + 12.66 * geometry.a1, 0.0453 + 0.28 * geometry.a1
    return Links(
        mass_1=mass,
        centre_1=0.46 * geometry.a1 - 0.0072,
        inertia_1=mass * gyration**2,
        mass_2=_MASS_2 * geometry.a2,
        centre_2=0.38 * geometry.a2,
        inertia_2=_MASS_2 * geometry.a2 * 0.126**2,
    )


class _Inertia(NamedTuple):
    """Terms of the law above, columns (k,)."""

    h11: Array
    h12: Array
    h22: Array
    turn: Array
    """B sin q2."""


@value_class(frozen=True, slots=True)
class ScaraDynamics(Dynamics):
    """Dynamics of a SCARA in terms of its torques; the third row is the acceleration of axis 3."""

    links: Links
    geometry: ScaraGeometry
    payload_kg: float
    """Rated payload."""
    turn: float
    """Acceleration of axis 4 [rad/s2]."""

    def rows(self, stance: Array, first: Array, second: Array, load: Array) -> tuple[Array, Array]:
        """Slope and bend (k, 3); see `Dynamics`."""
        inertia = self._inertia(stance, load)
        slope, bend = self._against(inertia, first), self._against(inertia, second)
        return slope, bend + self._of_speeds(inertia, first)

    def shares(self, stance: Array, rates: Array, changes: Array, load: Array) -> Array:
        """Shares of the torques (k, 3); see `Dynamics`."""
        inertia = self._inertia(stance, load)
        return self._against(inertia, changes) + self._of_speeds(inertia, rates)

    @property
    def torque_axes(self) -> int:
        """Axes 1 and 2."""
        return 2

    @property
    def wrist(self) -> tuple[float, ...]:
        """Accelerations of the axes after the third."""
        return (self.turn,)

    @property
    def least_accelerations(self) -> tuple[float, float, float]:
        """Accelerations of axes 1 to 3 of the stretched arm."""
        stretched = np.array([[0.0, 1.0, 0.0, 0.0]])
        inertia = self._inertia(stretched, np.zeros(1))
        of_turning = _LIMIT_1 / float(inertia.h11[0]), _LIMIT_2 / float(inertia.h22[0])
        return *of_turning, _LIFT / METRES_PER_UNIT

    def _inertia(self, stance: Array, load: Array) -> _Inertia:
        one, g = self.links, self.geometry
        sine, cosine = stance[:, 0], stance[:, 1]
        mass = load * self.payload_kg
        both = one.inertia_2 + one.mass_2 * one.centre_2**2 + mass * g.a2**2
        across = g.a1 * (one.mass_2 * one.centre_2 + mass * g.a2)
        foot = _ROTOR_1 + one.inertia_1 + one.mass_1 * one.centre_1**2
        return _Inertia(
            foot + (one.mass_2 + mass) * g.a1**2 + both + 2.0 * across * cosine,
            both + across * cosine,
            _ROTOR_2 + both,
            across * sine,
        )

    def _against(self, inertia: _Inertia, changes: Array) -> Array:
        """Return torques (k, 3) due to joint accelerations (k, 3)."""
        e1, e2, e3 = changes.T
        return np.stack(
            [
                (inertia.h11 * e1 + inertia.h12 * e2) / _LIMIT_1,
                (inertia.h12 * e1 + inertia.h22 * e2) / _LIMIT_2,
                e3 * (METRES_PER_UNIT / _LIFT),
            ],
            axis=-1,
        )

    def _of_speeds(self, inertia: _Inertia, rates: Array) -> Array:
        """Return torques (k, 3) due to products of joint rates (k, 3)."""
        q1, q2, _ = rates.T
        return np.stack(
            [
                -inertia.turn * (2.0 * q1 + q2) * q2 / _LIMIT_1,
                inertia.turn * q1 * q1 / _LIMIT_2,
                np.zeros(len(rates)),
            ],
            axis=-1,
        )
