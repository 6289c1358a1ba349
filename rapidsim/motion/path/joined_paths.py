"""Paths joined end to end, because points on many short paths cost as much as on one long path.

Between two paths there is a gap in which the arm rests at the end of the first, so that the end of
one path and the start of the next remain distinct points.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.blends import Corners, Limit
from rapidsim.motion.geometry.joint_mapping import Index, JointMapper
from rapidsim.motion.geometry.parameterisation import PathParameterisation
from rapidsim.motion.geometry.wrist_pair import WristPairs
from rapidsim.motion.path.path import Path
from rapidsim.values import value_class

Rows = TypeVar("Rows")

_GAP_M = 1e-3
_MOST_CURVES = 512
"""Maximum number of joined curves: many more would cost digits without a benefit."""
_NO_CORNER = -1


@value_class(frozen=True, slots=True, eq=False)
class JoinedPaths:
    """Several paths (k,) of one arm, the short ones joined end to end."""

    paths: tuple[Path, ...]
    on: Index
    """Shape (k,): index in `paths` of the joined path that contains each."""
    starts: Array
    """Shape (k,): start of each on its joined path [m]."""
    before: Index
    """Shape (k,): number of segments before each on its joined path."""


def joined_paths(paths: Sequence[Path]) -> JoinedPaths:
    """Join paths of one arm end to end.

    Joints, poses and travel agree with those of the paths, within the rounding of their common
    length. Joined paths serve evaluation only.
    """
    rows: list[list[Path]] = []
    size = _MOST_CURVES
    for path in paths:
        size += len(path.segments)
        # One robot's part of a synchronised path has another parameter.
        if size > _MOST_CURVES or not (_is_plain(path) and _is_plain(rows[-1][0])):
            rows.append([])
            size = len(path.segments)
        rows[-1].append(path)
    starts = [_starts(row) for row in rows]
    return JoinedPaths(
        tuple(_joined(row, at) for row, at in zip(rows, starts, strict=True)),
        np.repeat(np.arange(len(rows)), [len(row) for row in rows]),
        np.concatenate(starts),
        np.concatenate([_segments_before(row) for row in rows]),
    )


def _is_plain(path: Path) -> bool:
    """Whether a path may be joined: the arm is on it, over a parameter of its own."""
    return type(path) is Path and path.belts is None


def _starts(paths: Sequence[Path]) -> Array:
    lengths = np.array([path.length for path in paths]) + _GAP_M
    starts: Array = np.cumsum(lengths) - lengths
    return starts


def _segments_before(paths: Sequence[Path]) -> Index:
    counts = np.array([len(path.segments) for path in paths])
    before: Index = np.cumsum(counts) - counts
    return before


def _joined(paths: Sequence[Path], starts: Array) -> Path:
    if len(paths) == 1:
        return paths[0]
    before = _segments_before(paths)
    nodes = [
        dataclasses.replace(path.nodes, place=path.nodes.place + start)
        for path, start in zip(paths, starts, strict=True)
    ]
    return Path(
        segments=tuple(segment for path in paths for segment in path.segments),
        kinematics=paths[0].kinematics,
        layout=_layout([path.layout for path in paths], starts),
        arms=_arms([path.arms for path in paths]),
        active=np.concatenate([path.active + n for path, n in zip(paths, before, strict=True)]),
        nodes=_end_to_end(nodes),
        model=paths[0].model,
        lines=None,
    )


def _layout(layouts: Sequence[PathParameterisation], starts: Array) -> PathParameterisation:
    last = layouts[-1]
    rows = [len(layout.curves.length) for layout in layouts]
    before = np.cumsum(rows) - rows
    places = [layout.places[:-1] + start for layout, start in zip(layouts, starts, strict=True)]
    bounds = [layout.bounds + start for layout, start in zip(layouts, starts, strict=True)]

    def pieces(values: Sequence[Index], in_gap: Sequence[int]) -> Index:
        """Return values of pieces, with an entry for the gap after each path but the last."""
        with_gaps = [np.append(*both) for both in zip(values, in_gap, strict=True)]
        return np.concatenate(with_gaps)[:-1]

    def corners(name: str) -> Index:
        found: list[Index] = [getattr(layout, name) for layout in layouts]
        moved = [
            np.where(corner < 0, _NO_CORNER, corner + n)
            for corner, n in zip(found, before, strict=True)
        ]
        return pieces(moved, [_NO_CORNER] * len(layouts))

    own_rows = [layout.row + n for layout, n in zip(layouts, before, strict=True)]
    return PathParameterisation(
        curves=_end_to_end([layout.curves for layout in layouts]),
        corners=_corners([layout.corners for layout in layouts]),
        corner_shape=last.corner_shape,
        places=np.append(np.concatenate(places), starts[-1] + last.places[-1]),
        bounds=np.concatenate(bounds),
        row=pieces(own_rows, [int(row[-1]) for row in own_rows]),
        position_corner=corners("position_corner"),
        orientation_corner=corners("orientation_corner"),
        joint_corner=corners("joint_corner"),
    )


def _corners(found: Sequence[Corners]) -> Corners:
    """Return the corners of paths, with a stop point between each two."""
    none = np.zeros(1)
    stop = Corners(none, none, np.zeros(1, dtype=bool), np.full(1, Limit.STOP_POINT))
    return _end_to_end([part for corners in found for part in (stop, corners)][1:])


def _arms(arms: Sequence[JointMapper]) -> JointMapper:
    carriers = [one.carriers or (None,) * len(one.branch) for one in arms]
    turned = any(one.wrist_rate is not None for one in arms)
    led = next((one.pairs for one in arms if one.pairs is not None), None)
    return JointMapper(
        arms[0].kinematics,
        np.concatenate([one.branch for one in arms]),
        _end_to_end([one.tcp_from_flange for one in arms]),
        tuple(carrier for each in carriers for carrier in each) if any(map(any, carriers)) else (),
        np.concatenate([one.wrist_rows for one in arms]) if turned else None,
        np.concatenate([_wrist_rate(one) for one in arms]) if turned else None,
        None if led is None else _end_to_end([_pairs(one, led) for one in arms]),
    )


def _wrist_rate(arms: JointMapper) -> Array:
    if arms.wrist_rate is not None:
        return arms.wrist_rate
    return np.zeros((len(arms.branch), arms.kinematics.joint_count - 3))


def _pairs(arms: JointMapper, like: WristPairs) -> WristPairs:
    """Return the wrist pairs of curves; empty rows (-1) if there are none."""
    if arms.pairs is not None:
        return arms.pairs
    rows = {
        field.name: np.zeros((len(arms.branch), *getattr(like, field.name).shape[1:]))
        for field in dataclasses.fields(like)
    }
    return WristPairs(**{**rows, "axes": np.full((len(arms.branch), 2), -1)})


def _end_to_end(parts: Sequence[Rows]) -> Rows:
    """Concatenate values whose fields have one row per element."""
    values: Sequence[Any] = parts
    joined: Any
    if isinstance(values[0], np.ndarray):
        joined = np.concatenate(values)
    else:
        names = [field.name for field in dataclasses.fields(values[0])]
        joined = type(values[0])(*(_end_to_end([getattr(v, n) for v in values]) for n in names))
    result: Rows = joined
    return result
