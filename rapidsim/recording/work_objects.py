"""The work objects: user frame, object frame, and a faint plate in the object's plane.

The world is no work object of its own here: `wobj0` has no frames to show beside it.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import rerun as rr

from rapidsim.frames.transform import Array
from rapidsim.language.data import IDENTITY_POSE, WobjData
from rapidsim.motion.targets import base_from_object
from rapidsim.recording import palette
from rapidsim.recording.arm import FLANGE
from rapidsim.recording.changes import changes, stacked
from rapidsim.recording.sampled import SampledRun
from rapidsim.recording.timelines import indexes_at
from rapidsim.recording.tool import TCP
from rapidsim.recording.transforms import BASE, BASE_FROM_WORLD, WORLD, moving_frame
from rapidsim.simulation.result import ExecutedMove

ENTITY = "work_objects"

_THICKNESS = 0.002
_SMALLEST = 0.05
"""[m]; half the side of the smallest plate."""


def log_work_objects(stream: rr.RecordingStream, run: SampledRun, axis_m: float) -> None:
    """Log the frames of the work objects with axes of a length [m]."""
    for name, moves in _by_name(run.simulation.moves).items():
        users = changes(moves, lambda move: move.move.wobj.uframe)
        objects = changes(moves, lambda move: move.move.wobj.oframe)
        user_frame = f"{name}.uframe"
        for entity, parent, child, values in (
            ("user", BASE, user_frame, users),
            ("object", user_frame, name, objects),
        ):
            path = _entity(name, entity)
            stream.send_columns(
                path,
                indexes=indexes_at([change.time_s for change in values], run.simulation.moves),
                columns=moving_frame(parent, child, stacked(values)),
            )
            stream.log(
                path,
                rr.CoordinateFrame(child),
                rr.TransformAxes3D(axis_m if child == name else 0.6 * axis_m),
                static=True,
            )
        _log_plate(stream, name, moves)


def object_origins(moves: Sequence[ExecutedMove]) -> Array:
    """Where the object frames are (k, 3) [m] in the base."""
    used = dict.fromkeys(move.move.wobj for group in _by_name(moves).values() for move in group)
    origins = [base_from_object(wobj, BASE_FROM_WORLD).translation for wobj in used]
    return np.array(origins).reshape(-1, 3)


def _entity(name: str, part: str) -> str:
    """Where a part of a work object is logged; the name may be any expression, `wobjs{1}` too."""
    return rr.new_entity_path([ENTITY, name, part])


def _by_name(moves: Sequence[ExecutedMove]) -> dict[str, list[ExecutedMove]]:
    """The moves that use a work object of their own, by its name."""
    found: dict[str, list[ExecutedMove]] = {}
    for move in moves:
        wobj = move.move.wobj
        if wobj.uframe == IDENTITY_POSE and wobj.oframe == IDENTITY_POSE:
            continue
        name = " ".join(move.place.arguments.get("wobj", "wobj").split())
        if name in (WORLD, BASE, FLANGE, TCP):
            name = f"{name} (wobj)"
        found.setdefault(name, []).append(move)
    return found


def _log_plate(stream: rr.RecordingStream, name: str, moves: Sequence[ExecutedMove]) -> None:
    """A plate under the targets and the origin, in the plane of the object frame, and a name."""
    places: dict[WobjData, list[Array]] = {}
    for move in moves:
        places.setdefault(move.move.wobj, []).append(move.base_from_tcp.translation)
    in_plane = [np.zeros((1, 2))]
    for wobj, places_in_base in places.items():
        object_from_base = base_from_object(wobj, BASE_FROM_WORLD).inverse()
        in_plane.append(object_from_base.apply(np.array(places_in_base))[:, :2])
    corners = np.concatenate(in_plane)
    low, high = corners.min(axis=0), corners.max(axis=0)
    half = np.maximum(0.5 * (high - low) * 1.5, _SMALLEST)
    centre = 0.5 * (low + high)
    stream.log(
        _entity(name, "plate"),
        rr.CoordinateFrame(name),
        rr.Boxes3D(
            centers=[[*centre, -_THICKNESS]],
            half_sizes=[[*half, 0.5 * _THICKNESS]],
            colors=palette.rgba(palette.WORK_PLANE),
            fill_mode=rr.components.FillMode.Solid,
        ),
        static=True,
    )
    stream.log(
        _entity(name, "name"),
        rr.CoordinateFrame(name),
        rr.Points3D(
            [[*_emptiest_corner(centre, half, corners), 0.0]],
            radii=rr.Radius.ui_points(0.0),
            colors=palette.rgba(palette.FRAME_NAME),
            labels=[name],
            show_labels=True,
        ),
        static=True,
    )


def _emptiest_corner(centre: Array, half: Array, targets: Array) -> Array:
    """The corner (2,) of a plate farthest from all targets (k, 2), where a name covers nothing."""
    signs = np.array([[-1.0, 1.0], [1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    corners = centre + half * signs
    distances = np.linalg.norm(corners[:, None] - targets[None], axis=2).min(axis=1)
    # Rounded, so that corners equally far give the first of them on every machine.
    corner: Array = corners[int(np.argmax(np.round(distances, 6)))]
    return corner
