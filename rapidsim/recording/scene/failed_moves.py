"""Infeasible moves, in red: unreachable targets, points of failure on paths, and reasons.

They are visible from the start of the recording, before the robot arrives there. The reasons are on
pins above the cell, where they hide nothing.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import numpy as np
import rerun as rr

from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.frames.transform import Array
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot

TARGETS = "failed/targets"
WAYS = "failed/ways"
PLACES = "failed/places"
CODES = "failed/codes"
REASONS = "failed/reasons"
PINS = "failed/pins"

MOST_REASONS = 12
"""Number of reasons above which they overlap; the log has all of them."""
_LETTERS = 36
"""Width of a reason, in characters."""
_LINES = 4
"""Maximum number of lines of a reason; the log has the full text."""
_LOWEST_PIN = 0.24
_PIN_STEP = 0.22
"""Heights relative to the reach: of the lowest pin above the cell, and between pins."""
_FARTHEST = 2.5
"""Distance relative to the reach above which a target does not move the camera back."""
_APART = 1e-3
"""Distance [m] from the target below which a point on the path is the target."""


def log_failed(stream: rr.RecordingStream, run: RecordedRobot, mark_m: float) -> tuple[str, ...]:
    """Log the infeasible moves, with crosses of some size [m] on their paths.

    Returns:
        Remarks on content that the viewer cannot show correctly, one per line.
    """
    failed = run.robot_run.failed_moves
    if not failed:
        return ()
    frame = rr.CoordinateFrame(run.still_frame)
    red = palette.rgba(palette.FAILED)
    targets = np.array([move.base_from_tcp.translation for move in failed])
    stream.log(
        run.entity(TARGETS),
        frame,
        rr.Points3D(targets, radii=rr.Radius.ui_points(7.0), colors=red),
        static=True,
    )
    ways = [move.curve for move in failed if len(move.curve) > 1]
    if ways:
        stream.log(
            run.entity(WAYS),
            frame,
            rr.LineStrips3D(ways, radii=rr.Radius.ui_points(1.6), colors=red),
            static=True,
        )
    places = [move.fails_at for move in failed if fails_before_end(move)]
    if places:
        stream.log(
            run.entity(PLACES),
            frame,
            rr.LineStrips3D(
                [bar for place in places for bar in _cross(place, mark_m)],
                radii=rr.Radius.ui_points(2.6),
                colors=red,
            ),
            static=True,
        )
    told = failed[:MOST_REASONS]
    feet, heads = in_sight(run, told), pin_heads(run)
    stream.log(
        run.entity(PINS),
        frame,
        rr.LineStrips3D(
            np.stack([feet, heads], axis=1), radii=rr.Radius.ui_points(0.8), colors=red
        ),
        static=True,
    )
    for entity, stands, texts in (
        (REASONS, heads, [_reason(move) for move in told]),
        (CODES, feet, [f"{move.violation.code} line {move.place.span.line}" for move in told]),
    ):
        stream.log(
            run.entity(entity),
            frame,
            rr.Points3D(
                stands,
                radii=rr.Radius.ui_points(0.0),
                colors=red,
                labels=texts,
                show_labels=True,
            ),
            static=True,
        )
    if len(failed) > MOST_REASONS:
        return (f"{len(failed)} moves fail: the reasons of the first {MOST_REASONS} are shown",)
    return ()


def fails_before_end(move: FailedMove) -> bool:
    """Whether a move fails before its end."""
    end = move.base_from_tcp.translation
    return float(np.linalg.norm(move.fails_at - end)) > _APART


def pin_heads(run: RecordedRobot) -> Array:
    """Return the positions of the reasons (k, 3) [m] in base: above the cell, stacked."""
    feet = in_sight(run, run.robot_run.failed_moves[:MOST_REASONS])
    sweep = run.places
    top = max(float(sweep[:, 2].max()), 0.8 * _reach(run), *feet[:, 2])
    heads = feet.copy()
    heads[:, 2] = top + _reach(run) * (_LOWEST_PIN + _PIN_STEP * np.arange(len(feet)))
    return heads


def reason_room(run: RecordedRobot) -> Array:
    """Return points (4 k, 3) [m] around the reasons, so that their texts are in the picture."""
    aside = 0.3 * _reach(run) * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]])
    room: Array = (pin_heads(run)[:, None] + aside[None]).reshape(-1, 3)
    return room


def in_sight(run: RecordedRobot, failed: Sequence[FailedMove]) -> Array:
    """Return points of failure (k, 3) [m] in base, moved nearer if too far away to be shown."""
    places = np.array([move.fails_at for move in failed]).reshape(-1, 3)
    distance = np.linalg.norm(places, axis=1, keepdims=True)
    shown: Array = places * np.minimum(1.0, _FARTHEST * _reach(run) / np.maximum(distance, 1e-9))
    return shown


def _reach(run: RecordedRobot) -> float:
    """Return the approximate reach of the arm [m]."""
    farthest = float(np.linalg.norm(run.places, axis=1).max())
    return run.robot.reach_m or farthest


def _reason(move: FailedMove) -> str:
    violation = move.violation
    message = violation.message.replace("`", "")
    text = f"{violation.code} line {move.place.span.line}: {message}"
    return "\n".join(textwrap.wrap(text, _LETTERS, max_lines=_LINES, placeholder=" …"))


def _cross(place: Array, size_m: float) -> list[Array]:
    """Return three bars through a point (3,)."""
    return [np.stack([place - bar, place + bar]) for bar in size_m * np.eye(3)]
