"""Programmed targets: points, names and axes, each target once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import rerun as rr

from rapidsim.diagnostics import Severity
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Place
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot
from rapidsim.simulation.results.time_shares import end_point
from rapidsim.values import value_class

ENTITY = "targets"
NAMES_NEAR = f"{ENTITY}/names/near"
NAMES_FAR = f"{ENTITY}/names/far"

MOST_NAMES = 60
"""Number of targets above which names would overlap and are omitted."""
MOST_AXES = 2000
_APART = 0.02
"""Distance, relative to the extent of the work, within which targets share one label."""
_MOST_AT_A_PLACE = 3
"""Maximum number of names in a label; more would cover its target."""
_SAME = 1e-6
"""Distance [m] below which targets of one name are one target."""


@value_class(frozen=True, slots=True, eq=False)
class Target:
    """An end point of programmed moves."""

    name: str
    still_from_tcp: Transform
    on_line: bool
    """Whether a line or an arc ends there."""
    warned: bool
    """Whether there is a finding on a move that ends there."""
    visits: int = 1
    """Number of moves that end there."""


def targets_of(run: RecordedRobot) -> tuple[Target, ...]:
    """Return the targets of a run in the order of their first use."""
    warned = {
        (finding.span.file, finding.span.line)
        for finding in run.sampled.simulation.diagnostics
        if finding.span is not None and finding.severity is not Severity.NOTE
    }
    found: dict[tuple[object, ...], Target] = {}
    columns = run.robot_run.moves.columns
    ends = [run.still_from_end(row) for row in columns.rows]
    translations = np.array([end.translation for end in ends]).reshape(-1, 3)
    places = np.round(translations / _SAME).astype(np.int64).tolist()
    programmed = zip(columns.moves, columns.places, strict=True)
    for (move, of_text), still_from_tcp, place in zip(programmed, ends, places, strict=True):
        span = of_text.span
        target = Target(
            target_name(of_text),
            still_from_tcp,
            move.interpolation.leads_tcp,
            bool(warned) and (span.file, span.line) in warned,
        )
        key = (target.name, *place)
        known = found.get(key)
        if known is None:
            found[key] = target
        else:
            on_line, bad = known.on_line or target.on_line, known.warned or target.warned
            found[key] = replace(known, on_line=on_line, warned=bad, visits=known.visits + 1)
    return tuple(found.values())


def near_targets(targets: Sequence[Target]) -> tuple[Target, ...]:
    """Return the targets of the work: those on lines and arcs if they have an extent, else all."""
    on_lines = tuple(target for target in targets if target.on_line)
    return on_lines if extent(on_lines) > 0.0 else tuple(targets)


def extent(targets: Sequence[Target]) -> float:
    """Return the largest extent [m] of some targets along an axis; 0 for no targets."""
    if not targets:
        return 0.0
    return float(np.ptp(points_of(targets), axis=0).max())


def points_of(targets: Sequence[Target]) -> Array:
    """Return the positions of targets (k, 3) [m]."""
    return np.array([target.still_from_tcp.translation for target in targets])


def target_name(place: Place) -> str:
    """Return the end of a move as a short text."""
    text = end_point(place)
    return text if len(text) <= 24 else text[:23] + "…"


def log_targets(
    stream: rr.RecordingStream,
    run: RecordedRobot,
    targets: Sequence[Target],
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
    if not targets:
        return ()
    stream.log(
        run.entity(f"{ENTITY}/points"),
        rr.CoordinateFrame(run.still_frame),
        rr.Points3D(
            points_of(targets),
            radii=rr.Radius.ui_points(3.5),
            colors=np.array(
                [
                    palette.rgba(palette.WARNED if target.warned else palette.TARGET)
                    for target in targets
                ],
                dtype=np.uint32,
            ),
        ),
        static=True,
    )
    _log_axes(stream, run, targets[:MOST_AXES], axis_m)
    if len(targets) <= MOST_NAMES:
        near = near_targets(targets)
        far = [target for target in targets if target not in near]
        _log_names(stream, run, NAMES_NEAR, near, spacing_m=_APART * extent(near))
        _log_names(stream, run, NAMES_FAR, far, spacing_m=spacing_m)
        return ()
    remarks: tuple[str, ...] = (f"{len(targets)} targets: their names are not shown",)
    if len(targets) > MOST_AXES:
        remarks += (f"{len(targets)} targets: the first {MOST_AXES} have axes",)
    return remarks


def _log_names(
    stream: rr.RecordingStream,
    run: RecordedRobot,
    entity: str,
    targets: Sequence[Target],
    spacing_m: float,
) -> None:
    if not targets:
        return
    places, names = _gathered(targets, spacing_m)
    stream.log(
        run.entity(entity),
        rr.CoordinateFrame(run.still_frame),
        rr.Points3D(
            places,
            radii=rr.Radius.ui_points(0.0),
            colors=palette.rgba(palette.TARGET_NAME),
            labels=names,
            show_labels=True,
        ),
        static=True,
    )


def _log_axes(
    stream: rr.RecordingStream, run: RecordedRobot, targets: Sequence[Target], axis_m: float
) -> None:
    origins = np.repeat([target.still_from_tcp.translation for target in targets], 3, axis=0)
    # Columns of the rotation are the axes.
    columns = np.stack([target.still_from_tcp.rotation.T for target in targets])
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


def _gathered(targets: Sequence[Target], spacing_m: float) -> tuple[Array, list[str]]:
    """Return places that are some distance [m] apart, with the names of all targets near each."""
    names: list[dict[str, int]] = []
    places: list[Array] = []
    for target in targets:
        point = target.still_from_tcp.translation
        distances = [float(np.linalg.norm(place - point)) for place in places]
        nearest = int(np.argmin(distances)) if distances else -1
        if not distances or distances[nearest] > spacing_m:
            places.append(point)
            names.append({})
            nearest = len(names) - 1
        names[nearest][target.name] = names[nearest].get(target.name, 0) + target.visits
    return np.array(places), [_label(group) for group in names]


def _label(visits: Mapping[str, int]) -> str:
    """Return the names at a place with their numbers of visits; of many, only the first."""
    said = [name if times == 1 else f"{name} ({times}x)" for name, times in visits.items()]
    more = f" and {len(said) - _MOST_AT_A_PLACE} more" if len(said) > _MOST_AT_A_PLACE else ""
    return ", ".join(said[:_MOST_AT_A_PLACE]) + more
