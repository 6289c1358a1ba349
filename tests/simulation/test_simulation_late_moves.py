"""Moves that the program issues while the arm already brakes towards the end of the last one.

The arm has the speed of a plan that ends there; what is planned with the new move must not brake
harder than the arm can, whether it passes the corner or makes a stop of it.
"""

import random

import pytest
from laws import some
from motion_law import command_of, excess_of
from simulation_program import arm, ran

from rapidsim.motion.model import MotionModel
from rapidsim.motion.timing.axis_limits import limits_of

NO_AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
BRAKED_TOO_HARD = (38, 61, 147, 163, 186, 192, 206, 214)
"""Programs in which the first stage of a plan once took up what was too fast."""
ALL_SAMPLES = 1_000_000


def late_moves(seed: int) -> str:
    """A program that waits in most zones, most often shorter than the move lasts."""
    draw = random.Random(seed)

    def target() -> str:
        x, y, z = (draw.uniform(-r, r) for r in (200.0, 450.0, 200.0))
        return f"[[{700 + x:.1f},{y:.1f},{700 + z:.1f}],[0,0,1,0],[0,0,0,0],{NO_AXES}]"

    lines = [f"MoveJ {target()},v1000,fine,tool0;"]
    for _ in range(draw.randint(4, 8)):
        to = draw.choice(("MoveL ", "MoveL ", "MoveJ ", f"MoveC {target()},")) + target()
        speed = draw.choice(("v200", "v1000", "v2000", "vmax"))
        lines.append(f"{to},{speed},{draw.choice(('z1', 'z10', 'z20', 'z50', 'z100'))},tool0;")
        if draw.random() < 0.7:
            lines.append(f"WaitTime {draw.uniform(0.0, draw.choice((0.1, 0.4, 1.0))):.3f};")
    body = "\n".join(lines)
    return f"MODULE cell\nPROC main()\nConfJ\\Off;\nConfL\\Off;\n{body}\nENDPROC\nENDMODULE\n"


@pytest.mark.parametrize("seed", [*BRAKED_TOO_HARD, *some(range(250), 125)])
def test_late_moves_keep_torques_and_speeds(seed: int) -> None:
    run = ran(late_moves(seed)).run
    used = excess_of(command_of(run.only.trajectory), limits_of(arm(), MotionModel()), ALL_SAMPLES)
    assert used.axis_acceleration < 1.01
    assert max(used.axis_speed, used.tcp_speed) < 1.001
