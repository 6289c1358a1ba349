"""Tree of frames that the moves of a run refer to: base, tools, work objects, targets."""

from __future__ import annotations

from collections.abc import Iterator

from matplotlib.figure import Figure

from rapidsim.colours import Colours
from rapidsim.language.data import IDENTITY_POSE, Pose, RobTarget
from rapidsim.plots.sampled_run import target_name, title_of
from rapidsim.plots.theme import new_figure
from rapidsim.simulation.results.sampling import SampledRun
from rapidsim.values import value_class

_MOST_TARGETS = 12
"""Number of targets listed per work object; the others are only counted."""
_INDENT = 0.45
"""[inch]"""
_ROW = 0.27
"""[inch]"""
_DIGITS = "DejaVu Sans Mono"


@value_class(frozen=True, slots=True)
class _Row:
    depth: int
    name: str
    words: str
    """Pose of the frame in its parent."""


def frames_picture(run: SampledRun, theme: Colours) -> Figure:
    """Draw the tree, one row per frame, with positions in mm in the parent frame."""
    rows = list(_rows(run))
    height = 1.0 + _ROW * len(rows)
    figure = new_figure(f"Frames: {title_of(run)}", width=11.0, height=height)
    axes = figure.subplots()
    axes.set_axis_off()
    axes.set_xlim(0.0, 10.6)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    for number, row in enumerate(rows):
        x = 0.1 + _INDENT * row.depth
        parent = _parent(rows, number)
        if parent is not None:
            stem = x - 0.6 * _INDENT
            axes.plot(
                [stem, stem, x - 0.08],
                [parent + 0.3, number, number],
                color=theme.soft,
                linewidth=0.9,
                solid_joinstyle="miter",
            )
        axes.text(x, number, row.name, va="center", fontweight="bold", fontsize=9.0)
        axes.text(
            4.4, number, row.words, va="center", color=theme.soft, fontsize=8.0, family=_DIGITS
        )
    return figure


def _parent(rows: list[_Row], number: int) -> int | None:
    """Return the parent row of a row; None for the root."""
    depth = rows[number].depth
    return next((k for k in range(number - 1, -1, -1) if rows[k].depth < depth), None)


def _rows(run: SampledRun) -> Iterator[_Row]:
    moves = run.robot_run.moves
    yield _Row(0, "world", "")
    yield _Row(1, "base", f"foot of {run.robot_run.robot.title}")
    yield _Row(2, "tool0", "flange; moves with the joints")
    tools = dict.fromkeys(
        (_word(move.place.arguments.get("tool"), "tool0"), move.move.tool.tframe) for move in moves
    )
    for name, tframe in tools:
        if tframe != IDENTITY_POSE:
            yield _Row(3, name, _words(tframe))
    wobjs = dict.fromkeys(
        (_word(move.place.arguments.get("wobj"), "wobj0"), move.move.wobj) for move in moves
    )
    met: set[str] = set()
    for name, wobj in wobjs:
        if name in met:
            name = f"{name}, changed:"
        met.add(name)
        plain = wobj.uframe == IDENTITY_POSE and wobj.oframe == IDENTITY_POSE
        if plain:
            depth = 2
            yield _Row(1, name, "in the world")
        else:
            depth = 3
            yield _Row(1, f"{name} user frame", _words(wobj.uframe))
            yield _Row(2, f"{name} object frame", _words(wobj.oframe))
        targets: dict[tuple[str, str], None] = {}
        for move in moves:
            to = move.move.to
            if move.move.wobj == wobj and isinstance(to, RobTarget):
                targets[(target_name(move), _words(Pose(to.trans, to.rot)))] = None
        for target, words in list(targets)[:_MOST_TARGETS]:
            yield _Row(depth, target, words)
        if len(targets) > _MOST_TARGETS:
            yield _Row(depth, f"and {len(targets) - _MOST_TARGETS} more targets", "")


def _word(text: str | None, default: str) -> str:
    return " ".join(text.split()) if text else default


def _words(pose: Pose) -> str:
    x, y, z = pose.trans
    numbers = ",".join(f"{q:8.5f}" for q in pose.rot)
    return f"{x:9.2f} {y:9.2f} {z:9.2f} mm   [{numbers}]"
