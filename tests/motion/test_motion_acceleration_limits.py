"""PathAccLim and WorldAccLim: what the TCP does along and across its path, corners included."""

from typing import Any

import numpy as np
import pytest
from motion_programs import LIMITS, Programmer, path_of, zone

from rapidsim.frames.transform import Array
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling

STEP_S = 2e-3


def bend(**limits: Any) -> Path:
    """Two lines with a corner between, a joint move into another corner, half a circle."""
    program = Programmer().line((0.12, 0.0, 0.0), z=zone(30.0), **limits)
    program.line((0.0, 0.12, 0.0), z=zone(20.0), **limits)
    program.move((0.1, 0.05, -0.05, 0.1, 0.0, 0.2), zone(20.0), **limits)
    program.line((0.0, 0.1, 0.0), via=(0.05, 0.05, 0.0), **limits)
    return path_of(program)


def velocities(path: Path, timing: TimeScaling) -> Array:
    """Velocity of the TCP (k, 3) every `STEP_S`."""
    times = np.arange(0.0, timing.duration, STEP_S)
    tcp = path.evaluate(timing.s_at(times)).base_from_tcp.translation
    return np.diff(tcp, axis=0) / STEP_S


def test_along_the_path_the_tcp_gathers_speed_no_faster() -> None:
    free, path = bend(), bend(tcp_acceleration=1.5, tcp_deceleration=1.2)
    assert plan(free, LIMITS).duration < plan(path, LIMITS).duration
    speed = np.linalg.norm(velocities(path, plan(path, LIMITS)), axis=1)
    # The smaller of both limits counts for both.
    assert np.abs(np.diff(speed)).max() / STEP_S == pytest.approx(1.2, rel=0.03)


@pytest.mark.parametrize("limit", [0.8, 3.0])
def test_in_the_world_no_acceleration_is_larger(limit: float) -> None:
    path = bend(world_acceleration=limit)
    velocity = velocities(path, plan(path, LIMITS))
    size = np.linalg.norm(np.diff(velocity, axis=0), axis=1) / STEP_S
    # An octagon within the circle: up to 8 % is left unused.
    assert 0.9 * limit < size.max() < 1.01 * limit
