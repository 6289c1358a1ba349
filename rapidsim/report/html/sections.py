"""The parts of a report that are read: summary, findings, times, events, models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import sqrt
from pathlib import Path

from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.json_records.encoding import json_of
from rapidsim.motion.robot.external_axes import with_unit
from rapidsim.report.findings.merging import Finding, errors_first, merged
from rapidsim.report.html.collision_section import collision_tile
from rapidsim.report.html.elements import bar, prose, section, table, text, tile
from rapidsim.report.run.figures import Figures
from rapidsim.report.run.long_programs import lines_of
from rapidsim.report.run.run_models import models, of_robots
from rapidsim.simulation.results.active_limits import limits_of_moves, most_frequent
from rapidsim.simulation.results.curve_deviations import CurveDeviation, all_curve_deviations
from rapidsim.simulation.results.regions import Region, by_comment
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.slow_sections import slow_lines
from rapidsim.simulation.results.time_shares import Share, Step, by_line, by_routine
from rapidsim.simulation.results.verdict import Level, run_verdict

_MOST_FINDINGS = 200
_OPEN_FINDINGS = 6
_MOST_LINES = 300
_MOST_STRETCHES = 30
_MOST_EVENTS = 1500
_LONGEST_LINE = 160
_CLASSES = {Level.CLEAN: "good", Level.QUALIFIED: "warning", Level.FAILED: "error"}
"""Style classes of headlines."""


def head(simulation: Simulation) -> str:
    """The name of the program, the robot, and how the run ended."""
    verdict = run_verdict(simulation)
    robots = [one.robot.title for one in simulation.robots]
    return (
        f"<h1>{text(simulation.title)}</h1>"
        f'<p class="robot">{text(" and ".join(robots))}</p>'
        f'<p class="end {_CLASSES[verdict.level]}">{text(verdict.headline)}</p>'
    )


def summary(simulation: Simulation, figures: Figures, findings: Sequence[Diagnostic]) -> str:
    """The key figures."""
    corners = ", ".join(_corner(kind, count) for kind, count in figures.moves_by_corner)
    kinds = ", ".join(f"{count} {name}" for name, count in figures.moves_by_instruction)
    errors = sum(finding.severity is Severity.ERROR for finding in findings)
    warnings = sum(finding.severity is Severity.WARNING for finding in findings)
    several = len(simulation.robots) > 1
    tiles = [
        tile("Cycle time", f"{simulation.time_s:.3f} s", _sensitivity(figures)),
        tile("Moving", f"{simulation.motion_s:.3f} s", f"waiting {simulation.wait_s:.3f} s"),
        tile("Path of the TCP", f"{1000.0 * simulation.path_m:.1f} mm"),
        tile("Moves", f"{len(simulation.moves):,}", "; ".join(filter(None, (kinds, corners)))),
        tile("Findings", _counted(errors, "error"), _counted(warnings, "warning")),
    ]
    margin, singularity = figures.joint_margin, figures.singularity
    if margin:
        tiles.append(
            tile(
                f"Nearest joint limit{f' of {margin.move.task}' if several else ''}",
                with_unit(f"{margin.degrees:.1f}", margin.measure),
                f"joint {margin.joint}, {_at(simulation, margin.move)}",
            )
        )
    if singularity:
        tiles.append(
            tile(
                f"Nearest singularity{f' of {singularity.move.task}' if several else ''}",
                f"{singularity.smallest_singular_value:.3f}",
                f"smallest singular value, {_at(simulation, singularity.move)}; 0 is singular",
            )
        )
    tiles.append(collision_tile(simulation))
    return section("summary", "Summary", f'<div class="tiles">{"".join(tiles)}</div>')


def findings(diagnostics: Sequence[Diagnostic]) -> str:
    """The findings with their lines and suggestions, errors first."""
    all_of_them = errors_first(merged(diagnostics))
    told = all_of_them[:_MOST_FINDINGS]
    body = "".join(_finding(one) for one in told[:_OPEN_FINDINGS])
    folded = told[_OPEN_FINDINGS:]
    if folded:
        rest = "".join(_finding(one) for one in folded)
        body += f"<details><summary>{len(folded)} more</summary>{rest}</details>"
    left = len(all_of_them) - len(told)
    remark = f"the first {len(told)} of {len(all_of_them)}" if left else ""
    return section("findings", "Findings", body, remark)


def _finding(finding: Finding) -> str:
    first, violation = finding.first, finding.first.violation
    kind = first.severity.value
    where, line = "", ""
    if first.span is not None:
        routine = f" in {first.routine}" if first.routine else ""
        where = f"{first.span.file}:{first.span.line}{routine}"
        source = first.span.source.line(first.span.line).strip()
        line = f"<pre>{text(source[:_LONGEST_LINE])}</pre>"
    cf = f" (cf. {violation.cf})" if violation.cf else ""
    more = f" and {len(finding.repeats)} more like it" if finding.repeats else ""
    cure = _help(violation.help) if violation.help else ""
    title = f'<b class="code">{kind} {violation.code}</b>'
    return (
        f'<div class="finding {kind}"><p>{title} {prose(violation.message)}{text(cf)}</p>'
        f'<p class="where">{text(where)}{more}</p>'
        f"{line}{cure}</div>\n"
    )


def _help(words: str) -> str:
    """A suggestion; lines after the first are a block to paste."""
    first, *block = words.splitlines()
    pasted = "\n".join(map(text, block))
    return f'<p class="help">{prose(first)}</p>' + (f"<pre>{pasted}</pre>" if block else "")


def cycle_time(simulation: Simulation) -> str:
    """The time by routine and by line, the longest first; of all tasks."""
    steps: tuple[Step, ...] = (*simulation.moves, *simulation.waits)
    if not steps:
        return ""
    routines, lines = by_routine(steps), by_line(steps)
    deviations, limits = all_curve_deviations(simulation), limits_of_moves(simulation)
    left = lines[_MOST_LINES:]
    several = len({step.task for step in steps}) > 1
    note = (
        f'<p class="aside">and {len(left)} more lines with '
        f"{sum(share.seconds for share in left):.3f} s</p>"
        if left
        else ""
    )
    body = (
        _slow_sections(simulation)
        + _regions(by_comment(simulation.moves, simulation.waits))
        + "<h3>By routine</h3>"
        + table(
            ("routine", ">moves and waits", ">path [mm]", ">time [s]", ""),
            [_share_row(share, routines[0], several=several) for share in routines[:_MOST_LINES]],
            kind="times",
        )
        + '<h3>By line</h3><div class="scrolled">'
        + table(
            (
                "line",
                "move or wait",
                ">times",
                ">path [mm]",
                ">path deviation [mm]",
                "limited by",
                ">time [s]",
                "",
            ),
            [
                _share_row(
                    share,
                    lines[0],
                    [_off_curve(share, deviations), text(most_frequent(limits, share.moves))],
                    several=several,
                )
                for share in lines[:_MOST_LINES]
            ],
            kind="times",
        )
        + '</div><p class="aside">path deviation: largest distance of the TCP from the programmed '
        f"line or arc between its zones, and the root mean square; by forward kinematics</p>{note}"
    )
    return section(
        "times",
        "Cycle time",
        body,
        "in moves and waits; a wait while the robot moves counts for both lines",
    )


def _slow_sections(simulation: Simulation) -> str:
    """Slow sections: lines below the programmed speed, with the limit there."""
    found = slow_lines(simulation)
    if not found:
        return ""
    rows = [
        (
            text(lines_of(one.sections[0])),
            text(one.sections[0].limit),
            str(one.moves),
            f"{one.programmed_mm_s:.0f}",
            f"{one.reached_mm_s:.0f}",
            f"{one.seconds:.3f}",
            f"{one.lost_s:.3f}",
            bar(one.lost_s / found[0].lost_s if found[0].lost_s else 0.0),
        )
        for one in found[:_MOST_STRETCHES]
    ]
    heads = ("lines", "limited by", ">moves", ">programmed [mm/s]", ">mean [mm/s]", ">time [s]",
             ">lost [s]", "")  # fmt: skip
    left = len(found) - len(rows)
    more = f'<p class="aside">{left} shorter stretches not shown</p>' if left else ""
    table_of_them = table(heads, rows, kind="times")
    return (
        "<h3>Where the programmed speed is not reached</h3>"
        f'<div class="scrolled">{table_of_them}</div>{more}'
    )


def _regions(regions: Sequence[Region]) -> str:
    """The time by the comments that head parts of the program."""
    if len(regions) < 2:
        return ""
    rows = [
        (
            text(one.comment),
            text(f"{Path(one.file).name}:{one.line}"),
            str(one.steps),
            f"{one.seconds:.3f}",
            bar(one.seconds / regions[0].seconds if regions[0].seconds else 0.0),
        )
        for one in regions[:_MOST_LINES]
    ]
    table_of_them = table(
        ("comment", "line", ">moves and waits", ">time [s]", ""), rows, kind="times"
    )
    return f'<h3>By comment</h3><div class="scrolled">{table_of_them}</div>'


def _share_row(
    share: Share, longest: Share, of_line: Sequence[str] = (), *, several: bool
) -> list[str]:
    name = share.line if of_line else share.place.routine
    name = f"{share.task}: {name}" if several else name
    what = [text(name), text(f"{share.instruction} {share.goal}")] if of_line else [text(name)]
    width = share.seconds / longest.seconds if longest.seconds > 0.0 else 0.0
    return [
        *what,
        str(share.times),
        f"{share.length_mm:.1f}",
        *of_line,
        f"{share.seconds:.3f}",
        bar(width, waits=share.is_wait),
    ]


def _off_curve(share: Share, deviations: Mapping[int, CurveDeviation]) -> str:
    """Largest and rms deviation [mm] of the lines or arcs of a line; empty for joint moves."""
    found = [deviations[number] for number in share.moves if number in deviations]
    if not found:
        return ""
    rms = sqrt(sum(one.rms**2 for one in found) / len(found))
    return f"{1000.0 * max(one.largest for one in found):.3f}, rms {1000.0 * rms:.3f}"


def events(simulation: Simulation) -> str:
    """The events over time."""
    # Interrupts are omitted: they are many, and other events show their effects.
    told = [event for event in simulation.events if event.kind is not EventKind.INTERRUPT]
    several = len({event.task for event in told if event.place}) > 1
    rows = [
        (
            f"{event.time_s:.3f}",
            f'<span class="kind {event.kind.value}">{event.kind.value}</span>',
            text(_place(event, several)),
            prose(event.message),
        )
        for event in told[:_MOST_EVENTS]
    ]
    if not rows:
        return ""
    left = len(told) - len(rows)
    interrupts = len(simulation.events) - len(told)
    notes = [f"the first {len(rows)} of {len(told)}"] if left else []
    notes += [f"{interrupts} interrupts are not listed"] if interrupts else []
    body = table((">time [s]", "kind", "place", "message"), rows, kind="events")
    return section("events", "Events", f'<div class="scrolled">{body}</div>', "; ".join(notes))


def _place(event: Event, several: bool) -> str:
    """Routine and line, and the task where there is a choice."""
    if event.place is None:
        return ""
    task = f"{event.task} " if several else ""
    return f"{task}{event.place.routine}:{event.place.span.line}"


def assumptions(simulation: Simulation) -> str:
    """The models behind the numbers, what was not simulated, and the sources of the robots."""
    named = {
        "motion": "Motion model",
        "controller": "Controller",
        "acceleration": "Acceleration",
        "payload": "Payload",
        "axis_speed": "Axis speed",
        "corner": "Shape of corners",
        "program_pointer": "Program pointer",
        "filter_time_s": "Smoothing of the command [s]",
        "smoothing": "Smoothed motion",
        "ramp": "Ramp",
        "fine_dwell_s": "Time at a fine point [s]",
    }
    facts = [
        (text(named.get(name, name)), text(_rounded(value)))
        for name, value in json_of(models(simulation)).items()
        if name != "robot_not_modelled"
    ]
    not_modelled = of_robots(simulation, lambda robot: robot.not_modelled)
    notices = of_robots(simulation, lambda robot: robot.notices)
    sources = of_robots(simulation, lambda robot: robot.sources)
    facts += [("Not modelled of the robot", text(what)) for what in not_modelled]
    facts += [("Note", text(what)) for what in notices]
    facts += [
        (f"Not simulated: {text(one.name)}", text(f"{one.count} times, {one.treated_as}"))
        for one in simulation.unsimulated
    ]
    facts += [("Source of the robot's figures", text(what)) for what in sources]
    body = (
        "<p>Times are estimates. The robot maker's own virtual controller is the reference; "
        "compare where it matters.</p>" + table(("", ""), facts, kind="facts")
    )
    return section("models", "Models and assumptions", body, "what the numbers rest on")


def _rounded(value: object) -> object:
    """Seconds to milliseconds, as people write them; other values unchanged."""
    return f"{value:.3f}" if isinstance(value, float) else value


def _sensitivity(figures: Figures) -> str:
    """The time with other accelerations, which is the assumption that counts most."""
    return ", ".join(f"{one.time_s:.3f} s with {one.words}" for one in figures.sensitivity)


def _corner(kind: CornerKind, count: int) -> str:
    match kind:
        case CornerKind.FLY_BY:
            return f"{count} fly-by"
        case CornerKind.STOP:
            return _counted(count, "stop")
        case CornerKind.STOP_CORNER_PATH_FAILURE:
            return f"{_counted(count, 'stop')} because the next move came too late"


def _counted(count: int, name: str) -> str:
    return f"{count} {name}" if count == 1 else f"{count} {name}s"


def _at(simulation: Simulation, move: ExecutedMove) -> str:
    """The line of a move, and the file where there are several."""
    line = f"line {move.place.span.line}"
    return line if len(simulation.program) == 1 else f"{Path(move.place.span.file).name} {line}"
