"""The work objects: user frame, object frame, and a faint plate in the object's plane.

The world is no work object of its own here: `wobj0` has no frames to show beside it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import rerun as rr

from rapidsim.frames.transform import Array
from rapidsim.language.data import IDENTITY_POSE
from rapidsim.motion.targets import base_from_object, transform
from rapidsim.recording import palette
from rapidsim.recording.changes import changes, stacked
from rapidsim.recording.sampled import SampledRun
from rapidsim.recording.timelines import indexes_at
from rapidsim.recording.transforms import BASE, BASE_FROM_WORLD, moving_frame
from rapidsim.simulation.result import ExecutedMove

ENTITY = "work_objects"

_THICKNESS = 0.002
_SMALLEST = 0.05
"""[m]; half the side of the smallest plate."""


def log_work_objects(stream: rr.RecordingStream, run: SampledRun, axis_m: float) -> None:
    """Log the frames of the work objects with axes of a length [m]."""
    for name, moves in _by_name(run.simulation.moves).items():
        users = changes(moves, lambda move: transform(move.move.wobj.uframe))
        objects = changes(moves, lambda move: transform(move.move.wobj.oframe))
        user_frame = f"{name}.uframe"
        for entity, parent, child, values in (
            ("user", BASE, user_frame, users),
            ("object", user_frame, name, objects),
        ):
            path = f"{ENTITY}/{name}/{entity}"
            stream.send_columns(
                path,
                indexes=indexes_at([change.time_s for change in values], run.simulation.moves),
                columns=moving_frame(parent, child, stacked(values)),
            )
            shown = child == name
            stream.log(
                path,
                rr.CoordinateFrame(child),
                rr.TransformAxes3D(axis_m if shown else 0.6 * axis_m, show_frame=shown),
                static=True,
            )
        _log_plate(stream, name, moves)


def object_origins(moves: Sequence[ExecutedMove]) -> Array:
    """Where the object frames are (k, 3) [m] in the base."""
    origins = [
        base_from_object(move.move.wobj, BASE_FROM_WORLD).translation
        for group in _by_name(moves).values()
        for move in group
    ]
    return np.unique(np.array(origins).reshape(-1, 3), axis=0)


def _by_name(moves: Sequence[ExecutedMove]) -> dict[str, list[ExecutedMove]]:
    """The moves that use a work object of their own, by its name."""
    found: dict[str, list[ExecutedMove]] = {}
    for move in moves:
        wobj = move.move.wobj
        if wobj.uframe == IDENTITY_POSE and wobj.oframe == IDENTITY_POSE:
            continue
        name = " ".join(move.place.arguments.get("wobj", "wobj").split())
        found.setdefault(name, []).append(move)
    return found


def _log_plate(stream: rr.RecordingStream, name: str, moves: Sequence[ExecutedMove]) -> None:
    """A plate under the targets and the origin, in the plane of the object frame."""
    corners = [np.zeros(2)]
    for move in moves:
        object_from_base = base_from_object(move.move.wobj, BASE_FROM_WORLD).inverse()
        corners.append(object_from_base.apply(move.base_from_tcp.translation)[:2])
    low, high = np.min(corners, axis=0), np.max(corners, axis=0)
    half = np.maximum(0.5 * (high - low) * 1.5, _SMALLEST)
    centre = 0.5 * (low + high)
    stream.log(
        f"{ENTITY}/{name}/plate",
        rr.CoordinateFrame(name),
        rr.Boxes3D(
            centers=[[*centre, -_THICKNESS]],
            half_sizes=[[*half, 0.5 * _THICKNESS]],
            colors=palette.rgba(palette.WORK_PLANE),
            fill_mode=rr.components.FillMode.Solid,
        ),
        static=True,
    )
