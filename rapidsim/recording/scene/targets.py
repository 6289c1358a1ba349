"""Programmed targets: points, names and axes, each target once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
import rerun as rr

from rapidsim.controller.moves.executed_moves import Index, MoveColumns
from rapidsim.diagnostics import Severity
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Place
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot
from rapidsim.simulation.results.time_shares import end_point
from rapidsim.values import value_class

ENTITY = "targets"
NAMES_NEAR = f"{ENTITY}/names/near"
NAMES_FAR = f"{ENTITY}/names/far"

MOST_NAMES = 60
"""Number of names above which they would overlap and are omitted."""
MOST_AXES = 2000
"""Number of targets that have axes, and above which names are omitted."""
_MANY_PLACES = 3
"""Number of places of one name, as of `Offs(p,x,y,0)` in a loop, that share one label."""
_APART = 0.02
"""Distance, relative to the extent of the work, within which targets share one label."""
_MOST_AT_A_PLACE = 3
"""Maximum number of names in a label; more would cover its target."""
_SAME = 1e-6
"""Distance [m] below which targets of one name are one target."""


@value_class(frozen=True, slots=True, eq=False)
class Targets:
    """End points of programmed moves (k,), in the order of their first use."""

    run: RecordedRobot
    row: Index
    """Shape (k,): the first move that ends there."""
    points: Array
    """Shape (k, 3) [m], in the still frame."""
    on_line: Mask
    """Shape (k,): whether a line or an arc ends there."""
    warned: Mask
    """Shape (k,): whether there is a finding on a move that ends there."""
    visits: Index
    """Shape (k,): number of moves that end there."""

    def __len__(self) -> int:
        return len(self.row)

    def __getitem__(self, which: Mask | slice) -> Targets:
        """Return some of them."""
        columns = self.row, self.points, self.on_line, self.warned, self.visits
        return Targets(self.run, *(column[which] for column in columns))  # type: ignore[arg-type]

    @property
    def names(self) -> list[str]:
        """Their names."""
        places = self.run.robot_run.moves.columns.places
        return [target_name(places[row]) for row in self.row.tolist()]

    @property
    def poses(self) -> Transform:
        """Their poses (k,) in the still frame."""
        rows = self.run.robot_run.moves.columns.rows
        return Transform.stacked([self.run.still_from_end(rows[row]) for row in self.row.tolist()])


def targets_of(run: RecordedRobot) -> Targets:
    """Return the targets of a run."""
    columns = run.robot_run.moves.columns
    points = columns.end_m
    if run.on_track:
        points = np.array([run.still_from_end(row).translation for row in columns.rows])
        points = points.reshape(-1, 3)
    leads = np.array([move.interpolation.leads_tcp for move in columns.templates], dtype=np.bool_)
    label = _labels(np.round(points / _SAME).astype(np.int64), columns)
    _, first, target, visits = np.unique(
        label, return_index=True, return_inverse=True, return_counts=True
    )
    order = np.argsort(first)
    on_line, warned = (
        np.bincount(target, mask, minlength=len(first)) > 0.0
        for mask in (leads, _warned(run, columns))
    )
    row = first[order]
    return Targets(run, row, points[row], on_line[order], warned[order], visits[order])


def _labels(places: Index, columns: MoveColumns) -> Index:
    """Return a number (k,) for each place (k, 3), equal for the same place and name of a target."""
    if not len(places):
        return np.zeros(0, dtype=np.int64)
    order = np.lexsort(places.T)
    steps = np.any(np.diff(places[order], axis=0, prepend=places[order[:1]] - 1) != 0, axis=1)
    label = np.empty(len(places), dtype=np.int64)
    label[order] = np.cumsum(steps) - 1
    # Only at places of several targets do their names matter.
    shared = np.flatnonzero(np.bincount(label)[label] > 1)
    named: dict[tuple[int, str], int] = {}
    for at in shared.tolist():
        key = int(label[at]), target_name(columns.places[at])
        label[at] = len(places) + named.setdefault(key, len(named))
    return label


def _warned(run: RecordedRobot, columns: MoveColumns) -> Mask:
    """Return for each move (k,) whether there is a finding on its line."""
    warned = np.zeros(len(columns.rows), dtype=np.bool_)
    spans = [
        finding.span
        for finding in run.sampled.simulation.diagnostics
        if finding.span is not None and finding.severity is not Severity.NOTE
    ]
    if spans:
        files = np.array([source.file for source in columns.sources], dtype=np.object_)
        for file, line in {(span.file, span.line) for span in spans}:
            warned |= (columns.lines == line) & (files == file)
    return warned


def near_targets(targets: Targets) -> Targets:
    """Return the targets of the work: those on lines and arcs if they have an extent, else all."""
    on_lines = targets[targets.on_line]
    return on_lines if extent(on_lines) > 0.0 else targets


def extent(targets: Targets) -> float:
    """Return the largest extent [m] of some targets along an axis; 0 for no targets."""
    return float(np.ptp(targets.points, axis=0).max()) if len(targets) else 0.0


def target_name(place: Place) -> str:
    """Return the end of a move as a short text."""
    text = end_point(place)
    return text if len(text) <= 24 else text[:23] + "…"


def log_targets(
    stream: rr.RecordingStream,
    run: RecordedRobot,
    targets: Targets,
    *,
    axis_m: float,
    spacing_m: float,
) -> tuple[str, ...]:
    """Log targets.

    Args:
        stream: The recording.
        run: Run of the targets.
        targets: Targets to log.
        axis_m: Length [m] of their axes.
        spacing_m: Distance [m] below which names of targets far from the work are merged.

    Returns:
        Remarks on content that the viewer cannot show correctly, one per line.
    """
    if not len(targets):
        return ()
    stream.log(
        run.entity(f"{ENTITY}/points"),
        rr.CoordinateFrame(run.still_frame),
        rr.Points3D(
            targets.points,
            radii=rr.Radius.ui_points(3.5),
            colors=np.where(
                targets.warned, palette.rgba(palette.WARNED), palette.rgba(palette.TARGET)
            ).astype(np.uint32),
        ),
        static=True,
    )
    _log_axes(stream, run, targets[:MOST_AXES], axis_m)
    if len(targets) <= MOST_AXES:
        near = near_targets(targets)
        far = targets[~targets.on_line] if near is not targets else targets[:0]
        names_near, names_far = _named(near), _named(far)
        if len(names_near) + len(names_far) <= MOST_NAMES:
            _log_names(stream, run, NAMES_NEAR, names_near, spacing_m=_APART * extent(near))
            _log_names(stream, run, NAMES_FAR, names_far, spacing_m=spacing_m)
            return ()
    remarks: tuple[str, ...] = (f"{len(targets)} targets: their names are not shown",)
    if len(targets) > MOST_AXES:
        remarks += (f"{len(targets)} targets: the first {MOST_AXES} have axes",)
    return remarks


def _log_names(
    stream: rr.RecordingStream,
    run: RecordedRobot,
    entity: str,
    names: Sequence[_Name],
    spacing_m: float,
) -> None:
    if not names:
        return
    places, labels = _gathered(names, spacing_m)
    stream.log(
        run.entity(entity),
        rr.CoordinateFrame(run.still_frame),
        rr.Points3D(
            places,
            radii=rr.Radius.ui_points(0.0),
            colors=palette.rgba(palette.TARGET_NAME),
            labels=labels,
            show_labels=True,
        ),
        static=True,
    )


def _log_axes(
    stream: rr.RecordingStream, run: RecordedRobot, targets: Targets, axis_m: float
) -> None:
    poses = targets.poses
    origins = np.repeat(poses.translation, 3, axis=0)
    # Columns of the rotation are the axes.
    columns = np.swapaxes(poses.rotation, -1, -2)
    stream.log(
        run.entity(f"{ENTITY}/axes"),
        rr.CoordinateFrame(run.still_frame),
        rr.Arrows3D(
            origins=origins,
            vectors=columns.reshape(-1, 3) * axis_m,
            radii=[axis_m * 0.035],
            colors=np.tile([palette.rgba(axis) for axis in palette.AXES], len(targets)).astype(
                np.uint32
            ),
        ),
        static=True,
    )


@value_class(frozen=True, slots=True, eq=False)
class _Name:
    """Name at a place."""

    point: Array
    """Shape (3,) [m], in the still frame."""
    text: str
    visits: int


def _named(targets: Targets) -> list[_Name]:
    """Return the names of targets; one for all places of a name that has many."""
    names = targets.names
    places = Counter(names)
    merged: set[str] = set()
    result: list[_Name] = []
    for point, name, visits in zip(targets.points, names, targets.visits.tolist(), strict=True):
        if places[name] < _MANY_PLACES:
            result.append(_Name(point, name, visits))
        elif name not in merged:
            merged.add(name)
            result.append(_Name(point, f"{places[name]} places of {name}", 1))
    return result


def _gathered(names: Sequence[_Name], spacing_m: float) -> tuple[Array, list[str]]:
    """Return places that are some distance [m] apart, with all names near each."""
    groups: list[dict[str, int]] = []
    places: list[Array] = []
    for name in names:
        distances = [float(np.linalg.norm(place - name.point)) for place in places]
        nearest = int(np.argmin(distances)) if distances else -1
        if not distances or distances[nearest] > spacing_m:
            places.append(name.point)
            groups.append({})
            nearest = len(groups) - 1
        groups[nearest][name.text] = groups[nearest].get(name.text, 0) + name.visits
    return np.array(places), [_label(group) for group in groups]


def _label(visits: Mapping[str, int]) -> str:
    """Return the names at a place with their numbers of visits; of many, only the first."""
    said = [name if times == 1 else f"{name} ({times}x)" for name, times in visits.items()]
    more = f" and {len(said) - _MOST_AT_A_PLACE} more" if len(said) > _MOST_AT_A_PLACE else ""
    return ", ".join(said[:_MOST_AT_A_PLACE]) + more
