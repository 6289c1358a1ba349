"""Moves between two stop points that last less than the wait at one.

A controller prepares what follows a stop while the arm waits there. A move that is over sooner than
that is already followed by a prepared one: both stop points together take as long as one, most of
it before the move, and the move uses half of its torque.

Source: logs of stop points 2 mm apart on one path, at six speeds: both stops together take 68 to 77
ms less than two others from 300 mm/s on, and 24 ms less at 50 mm/s. The division between the two is
a fit: the first stop takes 78 to 82 ms of 102 ms, the second 18 to 29 ms.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rapidsim.controller.moves.queued_move import QueuedMove, nominal_s
from rapidsim.controller.queue.member import Member
from rapidsim.controller.queue.path_planner import PathPlanner
from rapidsim.motion.model import MotionModel

WAIT_BEFORE, WAIT_AFTER = 0.85, 0.3
"""Shares of the time at a stop point that remain before and after such a move."""
_TORQUE = 0.5
_LONGEST_S = 0.1
"""Longest command [s] of such a move, also where a stop point takes longer."""


def shares_a_wait(
    planner: PathPlanner, members: Sequence[Member], parts: Sequence[QueuedMove]
) -> bool:
    """Whether a move of robots at rest is brief; raises `MotionError` if it cannot be made."""
    model = members[0].model
    if any(map(_is_long, parts)) or not _waits(model):
        return False
    longest_s = min(model.dwell, _LONGEST_S)
    if max(nominal_s(one.segment) for one in parts) >= longest_s:
        return False
    _, timing = planner.plan([[one] for one in parts])
    return 0.0 < timing.duration < longest_s


def _is_long(queued: QueuedMove) -> bool:
    """Whether a move has no stop point, a time of its own, or follows a belt."""
    segment = queued.segment
    return bool(segment.zone or segment.duration or segment.rides)


def with_less_torque(queued: QueuedMove) -> None:
    """Let a move use less of its torque."""
    share = _TORQUE * queued.segment.acceleration_share
    queued.segment = replace(queued.segment, acceleration_share=share)


def _waits(model: MotionModel) -> bool:
    """Whether the arm may move on before it is quite at rest."""
    return model.version == "3" and model.smoothing == "axes"
