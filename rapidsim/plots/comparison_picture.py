"""MoveJ against MoveL: the paths of both to one target.

Between two targets MoveJ turns all joints in proportion, which is quick but not straight; MoveL
keeps the TCP on the line, if the arm can. Shown for the moves of the program with the farthest
ends, including the first one from the start of the run.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from rapidsim.colours import Colours
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.motion_findings import fault_violation
from rapidsim.frames.transform import Array
from rapidsim.language.data import RobTarget
from rapidsim.language.moves import Interpolation
from rapidsim.library.motion import PLAIN_MOVES
from rapidsim.motion.geometry.segments import Segment
from rapidsim.plots.sampled_run import MM, target_name, title_of
from rapidsim.plots.theme import new_figure
from rapidsim.simulation.results.linear_alternative import (
    LinearAlternative,
    linear_alternative,
    segments_of,
)
from rapidsim.simulation.results.move_kinds import MOVE_KINDS
from rapidsim.simulation.results.sampling import SampledRun
from rapidsim.simulation.results.simulation import RobotRun
from rapidsim.values import value_class

_POINTS = 101
_MOST_ROWS = 3
_NEAREST = 1e-3
"""Length [m] below which paths are not compared."""
_COMPARED = (Interpolation.JOINT, Interpolation.LINE, Interpolation.AXES)
_LETTERS = 150
"""Number of characters per line of text above a row."""


@value_class(frozen=True, slots=True, eq=False)
class ComparedMove:
    """A move, with the joint and the linear path to its end."""

    move: ExecutedMove
    line: LinearAlternative
    joint: Array
    """TCP (k, 3) [m] in base for a proportional motion of all joints."""

    @property
    def reason(self) -> str | None:
        """Reason why MoveL is infeasible, as reported by a run; None if it is feasible."""
        if self.line.fault is None:
            return None
        return fault_violation(self.line.fault, target_name(self.move)).message.replace("`", "")

    @property
    def remark(self) -> str | None:
        """Remark on the configuration at the end of the line; None if it is as stored."""
        to, arrival = self.move.move.to, self.line.arrival
        if arrival is None or not isinstance(to, RobTarget):
            return None
        stored = tuple(int(value) for value in to.robconf)
        if stored == arrival.confdata:
            return None
        return (
            f"the line arrives in configuration {_brackets(arrival.confdata)}, "
            f"not in the stored {_brackets(stored)}"
        )


def compared_moves(run: SampledRun) -> tuple[ComparedMove, ...]:
    """Return the moves whose ends are farthest from their starts, in the order of the program."""
    found: dict[tuple[str, ...], tuple[float, ExecutedMove, Segment]] = {}
    segments = segments_of(run.robot_run)
    for move in run.robot_run.moves:
        segment = segments.get(move.index)
        if segment is None or move.move.interpolation not in _COMPARED:
            continue
        ends = (segment.start.base_from_tcp.translation, segment.end.base_from_tcp.translation)
        far = float(np.linalg.norm(ends[1] - ends[0]))
        if far > _NEAREST:
            # Each path is included once, for any number of repetitions in either direction.
            key = tuple(sorted(",".join(f"{x:.3f}" for x in end.tolist()) for end in ends))
            found.setdefault(key, (far, move, segment))
    farthest = sorted(found.values(), key=lambda one: -one[0])
    kept: list[ComparedMove] = []
    for _, move, segment in farthest:
        line = linear_alternative(run.robot_run.robot, segment, run.simulation.model)
        if line is not None:
            kept.append(ComparedMove(move, line, _joint_motion_path(run.robot_run, segment)))
        if len(kept) == _MOST_ROWS:
            break
    return tuple(sorted(kept, key=lambda one: one.move.index))


def comparison_picture(run: SampledRun, theme: Colours) -> Figure | None:
    """Draw both paths from two sides, and their distance; None if nothing moves far."""
    compared = compared_moves(run)
    if not compared:
        return None
    height = 0.5 + 3.7 * len(compared)
    figure = new_figure(f"MoveJ and MoveL: {title_of(run)}", width=11.0, height=height)
    rows = figure.subfigures(len(compared), 1, squeeze=False)[:, 0]
    drawn: dict[str, Artist] = {}
    for row, one in zip(rows, compared, strict=True):
        _draw_row(row, one, theme)
        handles, labels = row.axes[0].get_legend_handles_labels()
        drawn.update(zip(labels, handles, strict=True))
    figure.legend(drawn.values(), drawn.keys(), loc="upper right", ncols=len(drawn))
    return figure


def _draw_row(row: SubFigure, compared: ComparedMove, theme: Colours) -> None:
    move, line = compared.move, compared.line
    told = compared.reason or compared.remark
    heading = f"line {move.place.span.line}: {move.move.instruction} {target_name(move)}"
    if told is not None:
        told = "\n".join(textwrap.wrap(f"MoveL: {told}", _LETTERS))
    # Empty lines in the heading reserve space for the text below it.
    lines = 1 if told is None else 2 + told.count("\n")
    row.suptitle(heading + "\n" * (lines - 1), x=0.015, ha="left", fontsize=10.5)
    above, side, apart = row.subplots(1, 3)
    for axes, shown, title in (
        (above, (0, 1), "from above, base frame"),
        (side, (0, 2), "from the side"),
    ):
        _draw_paths(axes, compared, theme, shown)
        axes.set_title(title)
    if told is not None:
        colour = theme.error if compared.reason else theme.soft
        row.text(0.015, 0.905, told, ha="left", va="top", fontsize=8.5, color=colour)
    distance = _off_the_line(compared.joint, line.start, line.end)
    colour = theme.moves[MOVE_KINDS[Interpolation.JOINT]]
    apart.plot(np.linspace(0.0, 100.0, _POINTS), distance, color=colour)
    own = _off_the_line(line.tcp, line.start, line.end)
    share = 100.0 * (1.0 if line.fault is None else line.fault.fraction)
    own_colour = theme.moves[MOVE_KINDS[Interpolation.LINE]]
    apart.plot(np.linspace(0.0, share, len(own)), own, color=own_colour)
    if line.fault is not None:
        _mark_fault(apart, theme, [share], [0.0])
        apart.plot([share, 100.0], [0.0, 0.0], color=theme.error, linestyle="--", linewidth=1.0)
    apart.set_title(f"MoveJ leaves the line by up to {distance.max():.1f} mm")
    apart.set_xlabel("way [%]")
    apart.set_ylabel("distance from the line [mm]")
    apart.set_xlim(0.0, 100.0)
    apart.set_ylim(-0.03 * max(float(distance.max()), 1.0), None)


def _draw_paths(axes: Axes, compared: ComparedMove, theme: Colours, view: tuple[int, int]) -> None:
    line = compared.line
    for way, kind in ((compared.joint, Interpolation.JOINT), (line.tcp, Interpolation.LINE)):
        places = MM * way[:, view]
        axes.plot(*places.T, color=theme.moves[MOVE_KINDS[kind]], label=PLAIN_MOVES[kind])
    if line.fails_at is not None:
        rest = MM * np.stack([line.fails_at, line.end])[:, view]
        axes.plot(*rest.T, color=theme.error, linestyle="--", linewidth=1.0)
        _mark_fault(axes, theme, rest[:1, 0], rest[:1, 1])
    ends = MM * np.stack([line.start, line.end])[:, view]
    axes.plot(*ends[:1].T, "o", color=theme.ink, markersize=5, fillstyle="none", label="start")
    axes.plot(*ends[1:].T, "o", color=theme.ink, markersize=4, label="end")
    axes.set_xlabel(f"{'xyz'[view[0]]} [mm]")
    axes.set_ylabel(f"{'xyz'[view[1]]} [mm]")
    axes.set_aspect("equal", adjustable="datalim")


def _mark_fault(
    axes: Axes, theme: Colours, x: Sequence[float] | Array, y: Sequence[float] | Array
) -> None:
    axes.plot(
        x,
        y,
        marker="x",
        linestyle="none",
        color=theme.error,
        markersize=8,
        markeredgewidth=2,
        label="MoveL fails",
        zorder=5,
        clip_on=False,
    )


def _joint_motion_path(robot_run: RobotRun, segment: Segment) -> Array:
    """Return the TCP (k, 3) [m] for a proportional motion of all joints."""
    share = np.linspace(0.0, 1.0, _POINTS)[:, None]
    joints = segment.start.joints + share * (segment.end.joints - segment.start.joints)
    flange_from_tcp = segment.tcp_from_flange.inverse()
    return (robot_run.robot.kinematics.forward(joints) @ flange_from_tcp).translation


def _off_the_line(arc_length: Array, start: Array, end: Array) -> Array:
    """Return distances (k,) [mm] of points (k, 3) [m] from the line through two points (3,) [m]."""
    along = (end - start) / np.linalg.norm(end - start)
    distance: Array = MM * np.linalg.norm(np.cross(arc_length - start, along), axis=1)
    return distance


def _brackets(conf: Sequence[int]) -> str:
    return f"[{','.join(map(str, conf))}]"
