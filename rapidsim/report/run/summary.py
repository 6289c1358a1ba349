"""The summary of a run for a person: how it ended, how long it took, where the time went.

Built of rich tables without boxes, so that it reads in 80 columns and in a log file.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from rich.console import Console, ConsoleOptions, Group, RenderableType, RenderResult
from rich.measure import Measurement
from rich.rule import Rule
from rich.table import Table
from rich.text import Text

from rapidsim.collisions.contact import FARTHEST_M
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.language.error_answers import ErrorOutcome
from rapidsim.motion.robot.external_axes import with_unit
from rapidsim.motion.robot.robot import LARGEST_EXCESS, Robot
from rapidsim.report.findings.source_frame import printable
from rapidsim.report.run.collision_records import clearance_records, crash_records
from rapidsim.report.run.error_records import errors_text
from rapidsim.report.run.figures import Figures, JointMargin, OffPath, SingularityMargin
from rapidsim.report.run.long_programs import long_program_text
from rapidsim.report.run.run_models import models, of_robots
from rapidsim.report.unbreakable_units import UnbreakableUnits
from rapidsim.report.untruncated_table import UntruncatedTable
from rapidsim.simulation.results.active_limits import most_frequent
from rapidsim.simulation.results.collisions import Collisions
from rapidsim.simulation.results.parts import PartCounts
from rapidsim.simulation.results.persistents import PersistentChange, parts_of
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.time_shares import Share
from rapidsim.simulation.results.verdict import Level, Verdict
from rapidsim.values import value_class

_BAR_CELLS = 24
_MOVE_CELLS = 22
_ROUTINE_CELLS = 14
_LINE_BAR_CELLS = 10
_ANY_WIDTH = 1000
_SLOWEST = 5
_SHOWN_TEXTS = 8
_SHOWN_PERSISTENTS = 8
_PAST_LIMIT_DEG = 0.005
"""An excess that two decimals show."""
_LOW_MARGIN_DEG = 5.0
_NEAR_SINGULAR = 0.05
_COLOURS = {Level.CLEAN: "green", Level.QUALIFIED: "yellow", Level.FAILED: "red"}


@value_class(frozen=True, slots=True)
class Bars:
    """The characters bars are made of."""

    full: str
    rest: str


BLOCK_BARS = Bars("█", "░")
ASCII_BARS = Bars("#", ".")


@value_class(frozen=True, slots=True)
class OutputFile:
    """A file the command wrote."""

    path: Path
    what: str
    """Kind of the file, such as "recording"."""
    opened_by: str | None = None
    """The command that shows it, if it takes one."""


def summary(
    simulation: Simulation,
    verdict: Verdict,
    figures: Figures,
    *,
    robot_reason: str | None,
    written: Sequence[OutputFile],
    bars: Bars = BLOCK_BARS,
) -> RenderableType:
    """The summary of a run.

    Args:
        simulation: The run.
        verdict: Its verdict, the first line.
        figures: Its figures.
        robot_reason: Why this robot, unless the user named it.
        written: Files of the command, the recording among them.
        bars: The characters bars are made of.
    """
    parts: list[RenderableType] = [
        UnbreakableUnits(_headline(simulation, verdict)),
        Rule(style="dim"),
        Text(),
    ]
    parts.append(_facts(simulation, figures, robot_reason, bars))
    slowest = sorted((*figures.slowest, *figures.slowest_robot_waits), key=lambda one: -one.seconds)
    of_many = long_program_text(simulation)
    if of_many is not None:
        parts += [Text(), of_many]
    elif slowest:
        parts += [Text(), _Slowest("slowest lines", slowest[:_SLOWEST], bars, figures.limits)]
    if figures.slowest_other_waits:
        parts += [Text(), _Slowest("without a robot", figures.slowest_other_waits, bars)]
    if simulation.moves:
        parts += [Text(), UnbreakableUnits(_models(simulation, figures))]
    if written or simulation.home_files:
        by_program = [f"{file.path} (by the program)" for file in simulation.home_files]
        parts += [Text(), files_text(written, by_program)]
    return Group(*parts)


def _headline(simulation: Simulation, verdict: Verdict) -> Text:
    return Text.assemble(
        (simulation.title, "bold"),
        f" on {' and '.join(one.robot.title for one in simulation.robots)} ",
        (verdict.headline, f"bold {_COLOURS[verdict.level]}"),
    )


def _facts(
    simulation: Simulation, figures: Figures, robot_reason: str | None, bars: Bars
) -> RenderableType:
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="cyan", no_wrap=True)
    facts.add_column()
    several = len(simulation.robots) > 1
    reason = f" ({robot_reason})" if robot_reason else ""
    for number, one in enumerate(simulation.robots):
        whose = f" of {one.task}" if several else ""
        facts.add_row("" if number else "robot", f"{one.robot.name}{whose}{reason}")
        reason = ""
    facts.add_row("time", UnbreakableUnits(_time_split(simulation, bars)))
    facts.add_row("moves", UnbreakableUnits(_moves(simulation, figures)))
    if figures.moves_by_corner:
        facts.add_row("corners", UnbreakableUnits(_corners(figures)))
    if figures.joint_margin:
        facts.add_row("joint limits", _margin(figures.joint_margin, several=several))
    if figures.off_path:
        facts.add_row("off the path", _off_path(figures.off_path, several=several))
    if figures.singularity:
        facts.add_row("singularity", _singularity(figures.singularity, several=several))
    if simulation.collisions is not None:
        facts.add_row("collisions", _collisions(simulation, simulation.collisions))
        if simulation.collisions.part_events:
            facts.add_row("parts", _parts(simulation.collisions.part_counts))
    for name, value in _event_rows(simulation):
        facts.add_row(name, value)
    return facts


def _time_split(simulation: Simulation, bars: Bars) -> Text:
    total = simulation.time_s
    if total <= 0.0:
        return Text("no time passed")
    moving = round(_BAR_CELLS * min(1.0, simulation.motion_s / total))
    return Text.assemble(
        (bars.full * moving, "green"),
        (bars.rest * (_BAR_CELLS - moving), "yellow"),
        ("  moving ", "green"),
        f"{simulation.motion_s:.3f} s",
        ("  waiting ", "yellow"),
        f"{simulation.wait_s:.3f} s",
    )


def _moves(simulation: Simulation, figures: Figures) -> str:
    moves = simulation.moves
    if not moves:
        return "none"
    kinds = ", ".join(f"{count} {name}" for name, count in figures.moves_by_instruction)
    return f"{len(moves)} ({kinds}), {simulation.path_m * 1000.0:.1f} mm travelled"


def _corners(figures: Figures) -> Text:
    late = "because the next move came too late (cf.\u00a0ABB\u00a050024)"
    texts = []
    for kind, count in figures.moves_by_corner:
        stops = f"{count} stop{'' if count == 1 else 's'}"
        match kind:
            case CornerKind.FLY_BY:
                texts.append(Text(f"{count} fly-by"))
            case CornerKind.STOP:
                texts.append(Text(stops))
            case CornerKind.STOP_CORNER_PATH_FAILURE:
                texts.append(Text(f"{stops} {late}", "yellow"))
    return Text(", ").join(texts)


def _margin(margin: JointMargin, *, several: bool) -> Text:
    whose = f" of {margin.move.task}" if several else ""
    left = with_unit(f"{margin.degrees:.1f}", margin.measure)
    near = f"came within {left} of its limit{_at(margin.move)}"
    if margin.degrees < -_PAST_LIMIT_DEG:
        past = with_unit(f"{-margin.degrees:.2f}", margin.measure)
        near = f"went {past} past its limit{_at(margin.move)}"
    text = f"joint {margin.joint}{whose} {near}"
    return Text(text, "yellow" if margin.degrees < _LOW_MARGIN_DEG else "")


def _off_path(off: OffPath, *, several: bool) -> str:
    whose = f" of {off.move.task}" if several else ""
    return f"smoothing takes the TCP{whose} at most {off.mm:.3g} mm off its path{_at(off.move)}"


def _singularity(singularity: SingularityMargin, *, several: bool) -> Text:
    value = singularity.smallest_singular_value
    whose = f" of {singularity.move.task}" if several else ""
    text = f"closest to singular{whose}: {value:.3f} (0 = singular){_at(singularity.move)}"
    return Text(text, "yellow" if value < _NEAR_SINGULAR else "")


def _collisions(simulation: Simulation, collisions: Collisions) -> Text:
    """The first contact, or how near bodies came, and what the shapes are worth."""
    until_s = collisions.report.until_s
    searched = f"up to {until_s:.3f} s: " if until_s < math.inf else ""
    if crashes := crash_records(simulation):
        first = crashes[0]
        times = "once" if len(crashes) == 1 else f"{len(crashes)} times, first"
        where = "" if first.file is None else f" at {Path(first.file).name}:{first.line}"
        text = Text(
            f"{times} at {first.time_s:.3f} s{where}: {first.first} and {first.second}", "red"
        )
    elif near := next(iter(clearance_records(simulation)), None):
        where = "" if near.file is None else f" at {Path(near.file).name}:{near.line}"
        low = near.distance_mm < collisions.geometry.clearance_m * 1000.0
        pair = f"{near.first} and {near.second}{where}"
        text = Text(
            f"{searched}none; closest {near.distance_mm:.1f} mm, {pair}", "yellow" if low else ""
        )
    else:
        text = Text(f"{searched}none; nothing came within {FARTHEST_M * 1000.0:g} mm")
    for what in shape_margins(simulation, collisions):
        text.append(f"\n{what}", "dim")
    for what in collisions.remarks:
        text.append(f"\nnot checked: {what}", "yellow")
    return text


def _parts(counts: PartCounts) -> Text:
    """Number of parts, and of those that were moved and lost."""
    said = f"{counts.total}: {counts.moved} moved"
    said += f", {counts.delivered} delivered" if counts.delivered else ""
    said += f", {counts.lost} lost" if counts.lost else ""
    return Text(said, "red" if counts.lost else "")


def shape_margins(simulation: Simulation, collisions: Collisions) -> list[str]:
    """Notes on the accuracy of the judged bodies, a line each."""
    drawn = [one.robot for one in simulation.robots if one.robot.meshes is None]
    likenesses = {robot.name: robot for robot in drawn if robot.maker is not None}
    said = [_likeness(robot) for robot in likenesses.values()]
    if collisions.hollow_m:
        depth = collisions.hollow_m * 1000.0
        said.append(f"convex hulls fill hollows of bodies up to {depth:.1f} mm deep")
    return said


def _likeness(robot: Robot) -> str:
    """Note on the accuracy of the link shapes of a catalogue arm."""
    compared = [round(excess * 1000.0) for excess in robot.link_excess_m]
    text = f"the links of {robot.name} are approximations: "
    if compared:
        text += (
            f"95 % of the maker's surface lies within {max(compared)} mm of them, "
            f"from link 3 on within {max(compared[3:])} mm"
        )
    elif robot.reach_m is not None:
        body, wrist = (round(share * robot.reach_m * 1000.0, -1) for share in LARGEST_EXCESS)
        text += (
            f"the maker's may lie {body:g} mm beyond them, from link 3 on {wrist:g} mm, "
            "as on arms that were compared"
        )
    else:
        text += "they were not compared with the maker's"
    return f"{text}; keep a margin"


def _event_rows(simulation: Simulation) -> list[tuple[str, RenderableType]]:
    """Rows that only some runs have."""
    rows: list[tuple[str, RenderableType]] = []
    counts = Counter(event.kind for event in simulation.events)
    if interrupts := counts[EventKind.INTERRUPT]:
        rows.append(("interrupts", str(interrupts)))
    if signals := counts[EventKind.SIGNAL]:
        rows.append(("signals", f"{signals} change{'s' if signals > 1 else ''}"))
    if errors := errors_text(simulation):
        lost = {ErrorOutcome.FELL_THROUGH, ErrorOutcome.ENDED}
        lasting = any(tally.error.outcome in lost for tally in simulation.errors)
        rows.append(("errors", Text(printable(errors), "yellow" if lasting else "")))
    texts = [event for event in simulation.events if event.kind is EventKind.TEXT]
    if texts:
        shown = Text("\n").join(
            Text.assemble((f"{event.time_s:.3f} s  ", "dim"), printable(event.message))
            for event in texts[:_SHOWN_TEXTS]
        )
        if len(texts) > _SHOWN_TEXTS:
            shown.append(f"\nand {len(texts) - _SHOWN_TEXTS} more", "dim")
        rows.append(("operator", shown))
    if simulation.unsimulated:
        lines = (
            f"{one.name} ({one.count} {'time' if one.count == 1 else 'times'}): {one.treated_as}"
            for one in simulation.unsimulated
        )
        rows.append(("not simulated", Text("\n".join(lines), "yellow")))
    if simulation.persistents:
        rows.append(("persistents", _persistents(simulation.persistents)))
    return rows


def _persistents(changes: Sequence[PersistentChange]) -> Text:
    """Persistents that the run changed; of records and arrays the first changed part.

    A persistent that several modules declare is listed once.
    """
    alike: dict[tuple[str, str], list[PersistentChange]] = {}
    for one in changes:
        alike.setdefault((one.name.lower(), one.new), []).append(one)
    groups = list(alike.values())
    shown = Text("\n").join(
        Text.assemble(
            f"{first.name} ",
            (f"({', '.join(dict.fromkeys(one.module for one in (first, *others)))}) ", "dim"),
            printable(_change(first)),
        )
        for first, *others in groups[:_SHOWN_PERSISTENTS]
    )
    if len(groups) > _SHOWN_PERSISTENTS:
        shown.append(f"\nand {len(groups) - _SHOWN_PERSISTENTS} more", "dim")
    return shown


def _change(change: PersistentChange) -> str:
    old, new = parts_of(change.old), parts_of(change.new)
    changed = [pair for pair in zip(old, new, strict=True) if pair[0] != pair[1]]
    first = f"{changed[0][0]} -> {changed[0][1]}"
    if len(old) == 1:
        return first
    return f"{first}, {len(changed)} of {len(old)} values changed"


@value_class(frozen=True, slots=True)
class _Slowest:
    """The slowest lines, with the most important columns that fit."""

    title: str
    lines: Sequence[Share]
    bars: Bars
    limits: Mapping[int, str] | None = None

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        for routines in (True, False):
            table = _slowest(self, routines=routines)
            needed = Measurement.get(console, options.update(max_width=_ANY_WIDTH), table).maximum
            if needed - _LINE_BAR_CELLS <= options.max_width:
                yield table
                return
        yield _slowest_narrow(self.title, self.lines)


def _slowest_narrow(title: str, lines: Sequence[Share]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False, header_style="cyan")
    table.add_column(title, overflow="fold")
    table.add_column("move or wait", overflow="fold")
    table.add_column("time", justify="right", no_wrap=True)
    for line in lines:
        what = f"{line.instruction} {printable(line.goal)}"
        table.add_row(line.line, what, f"{line.seconds:.3f} s")
    return table


def _slowest(shown: _Slowest, *, routines: bool) -> Table:
    lines, bars, limits = shown.lines, shown.bars, shown.limits
    table = UntruncatedTable.without_lines()
    table.add_column(shown.title, no_wrap=True)
    if routines:
        table.add_column("routine", no_wrap=True, max_width=_ROUTINE_CELLS)
    table.add_column("move or wait", no_wrap=True, max_width=_MOVE_CELLS)
    table.add_column("times", justify="right", no_wrap=True)
    table.add_column("time", justify="right", no_wrap=True)
    if limits:
        table.add_column("limited by", no_wrap=True)
    table.add_column("", no_wrap=True, overflow="crop")
    longest = max(line.seconds for line in lines) or 1.0
    for line in lines:
        bar, colour = (bars.rest, "yellow") if line.is_wait else (bars.full, "green")
        table.add_row(
            line.line,
            *([line.place.routine] if routines else []),
            f"{line.instruction} {printable(line.goal)}",
            str(line.times),
            f"{line.seconds:.3f} s",
            *([most_frequent(limits, line.moves)] if limits else []),
            Text(bar * round(_LINE_BAR_CELLS * line.seconds / longest), colour),
        )
    return table


def _models(simulation: Simulation, figures: Figures) -> Text:
    others = " and ".join(
        f"{other.time_s:.3f} s with {other.words}" for other in figures.sensitivity
    )
    behind = models(simulation)
    speeds = f"{behind.axis_speed}; " if behind.axis_speed else ""
    smoothed = "each axis" if behind.smoothing == "axes" else "command"
    ramps = f"; {behind.ramp}" if behind.ramp else ""
    load = f"; {behind.payload}" if behind.payload else ""
    real = ", real arm" if behind.controller == "real" else ""
    not_modelled = of_robots(simulation, lambda robot: robot.not_modelled)
    left_out = "".join(f" Not modelled: {what}." for what in not_modelled)
    return Text(
        f"Models: motion model {behind.motion}{real}; {speeds}"
        f"{behind.acceleration}{load}; corner shape {behind.corner}; "
        f"{smoothed} smoothed over {behind.filter_time_s:.3f} s{ramps}; "
        f"dwell {behind.fine_dwell_s:.3f} s at fine points; "
        f"the program pointer {behind.program_pointer}.{left_out}"
        f"{f' The run takes {others}.' if others else ''}",
        "dim",
    )


def files_text(written: Sequence[OutputFile], other_files: Sequence[str] = ()) -> Text:
    """The files that were written, and how to open a recording among them."""
    text = Text(
        f"Written: {', '.join([*(f'{one.path} ({one.what})' for one in written), *other_files])}"
    )
    for one in written:
        if one.opened_by is not None:
            text.append(f"\nOpen the {one.what} with: ")
            text.append(one.opened_by, "bold")
    return text


def _at(move: ExecutedMove) -> str:
    span = move.place.span
    return f" at {Path(span.file).name}:{span.line}"
