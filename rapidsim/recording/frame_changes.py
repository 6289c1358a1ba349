"""Changes of frames that moves refer to: the first value holds from the start."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Transform
from rapidsim.language.data import Pose
from rapidsim.motion.configurations.targets import transform
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class FrameChange:
    """A value of a frame from an instant on."""

    time_s: float
    frame: Transform
    parent: str = ""
    """Parent frame, for frames whose parent may change; else empty."""


def changes(
    moves: Iterable[ExecutedMove],
    frame_of: Callable[[ExecutedMove], Pose],
    parent_of: Callable[[ExecutedMove], str] = lambda _: "",
) -> tuple[FrameChange, ...]:
    """Values of a frame over some moves, each with its first instant [s]; empty for no moves.

    The first value holds from 0 s: the arm has its tool before it moves.
    """
    found: list[FrameChange] = []
    last: tuple[Pose, str] | None = None
    for move in moves:
        frame = frame_of(move), parent_of(move)
        if frame != last:
            found.append(FrameChange(move.start_s if found else 0.0, transform(frame[0]), frame[1]))
            last = frame
    return tuple(found)


def stacked(values: tuple[FrameChange, ...]) -> Transform:
    """Return the frames of some changes as a batch (k,)."""
    return Transform(
        np.stack([change.frame.rotation for change in values]),
        np.stack([change.frame.translation for change in values]),
    )
