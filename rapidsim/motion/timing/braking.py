r"""Stopping on the path: braking that keeps the axes' accelerations and the path.

Stopping distances at 50 mm/s are from "SearchL" in the Technical reference manual RAPID
Instructions, Functions and Data types: 15 to 25 mm with \PStop, 4 to 8 with \SStop, 1 to 3 with
\Stop. The assumption that the time, not the distance, is equal at other speeds is our choice.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.axis_limits import Limits, limits_along
from rapidsim.motion.timing.constraints import Limiter, Quantity
from rapidsim.motion.timing.discretisation import cells_of
from rapidsim.motion.timing.problem import problem_of
from rapidsim.motion.timing.stages import Stages
from rapidsim.motion.timing.time_optimal import fastest_drive
from rapidsim.motion.timing.time_scaling import TimeScaling

PATH_STOP_S = 0.7
r"""Braking time [s] of a path stop, the gentlest: \PStop."""
PROGRAM_STOP_S = 0.3
"""Braking time [s] of a program stop: our choice, about the values in tables of stopping times."""
SOFT_STOP_S = 0.15
r"""Braking time [s] of a soft stop: \SStop."""
_STANDSTILL = 1e-9
"""Path speed [m/s] that counts as rest."""
_BEFORE_S = 1.0
_AFTER_S = 4.0
"""Interval [s] of a plan, before and after the instant, for which braking is computed: a block may
last for hours."""


def stop_at(
    path: Path, limits: Limits, timing: TimeScaling, time_s: float, in_s: float = 0.0
) -> TimeScaling:
    """Brake on a path, uniformly in a requested time or as fast as the axes can.

    Args:
        path: The geometry.
        limits: Axis limits.
        timing: The plan that the arm was following.
        time_s: Start of braking [s], in the plan's time.
        in_s: Braking time [s], unless the axes or the end of the path require another time.

    Returns:
        The motion to rest; its last `s` is where the arm stops. Time 0 is at its first `s`.
    """
    s, speed = timing.s_at(time_s), timing.speed_at(time_s)
    limits = limits_along(path, limits)
    if speed <= _STANDSTILL or s >= path.length:
        return TimeScaling(np.full(2, s), np.zeros(2), 0.0)
    hardest = speed / in_s if in_s > 0.0 else np.inf
    after_s = time_s + _AFTER_S
    nodes, x = _braked(
        path, limits, s, speed, hardest, (timing.s_at(time_s - _BEFORE_S), timing.s_at(after_s))
    )
    # Near the end of the interval, the interval itself makes the arm brake.
    if nodes[-1] > timing.s_at(time_s + 0.5 * _AFTER_S) and after_s < timing.duration:
        nodes, x = _braked(path, limits, s, speed, hardest, (0.0, path.length))
    active = np.zeros(len(nodes) - 1, dtype=np.int16)
    return TimeScaling(nodes, np.sqrt(x), 0.0, (Limiter(Quantity.STOP),), active)


def _braked(
    path: Path, limits: Limits, s: float, speed: float, hardest: float, within: tuple[float, float]
) -> tuple[Array, Array]:
    """Return nodes [m] from a position to the stop, and x there.

    `hardest` is the largest deceleration [m/s^2]; only the path `within` two positions [m] is
    evaluated.
    """
    problem = problem_of(path, cells_of(path, limits, s, within=within), limits)
    # Use the stages of the plan that had this speed here.
    _, motion = fastest_drive(problem, speed)
    stands, x = _along(motion.stages, motion.x, speed, hardest)
    nodes = motion.stages.nodes[: len(x)].copy()
    nodes[-1] = stands
    return nodes, x


def _along(stages: Stages, fastest: Array, speed: float, hardest: float) -> tuple[float, Array]:
    """Return the position [m] of the stop, and x at the nodes up to it, the last of them 0.

    `fastest` (m + 1,) is the x of the plan at the nodes, `hardest` the deceleration limit [m/s^2].
    """
    x = [speed**2]
    nodes = stages.nodes.tolist()
    rows = zip(stages.slack, stages.tilt, fastest[1:].tolist(), strict=True)
    for k, (slack, tilt, most) in enumerate(rows):
        # Every row requires u >= -slack - tilt x. In a corner that may mean a short acceleration:
        # an axis that the corner brakes as hard as it can must not be braked more.
        u = max(float(np.max(-slack - tilt * x[-1])), -hardest)
        after = min(x[-1] + 2.0 * u * (nodes[k + 1] - nodes[k]), most)
        if after <= 0.0:
            x.append(0.0)
            return min(nodes[k] - x[-2] / min(2.0 * u, -1e-300), nodes[k + 1]), np.array(x)
        x.append(after)
    x[-1] = 0.0
    return nodes[-1], np.array(x)
