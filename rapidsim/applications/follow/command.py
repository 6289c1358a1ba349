"""`rapidsim follow`: points of a table as a trajectory, as the arm can run it, and how well."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.declared import argument, option, options_of, shared
from rapidsim.cli.options.new_files import new_plots, new_recording, new_trace
from rapidsim.cli.options.numbers import POSITIVE, NumberOption, numbers
from rapidsim.cli.options.poses import (
    base_option,
    convention_option,
    line_option,
    line_points,
    scale_option,
    world_from_base,
)
from rapidsim.cli.terminal import (
    current_terminal,
    echo,
    print_json,
    table_or_json,
    terminal_options,
)
from rapidsim.extras import require
from rapidsim.files import InputError, decode, input_bytes, standard_input
from rapidsim.jobs.inputs.robot_choice import DEFAULT_ROBOT
from rapidsim.json_records.encoding import json_of
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.applications.follow.follow_steps import FollowOptions, PreparedPoints
    from rapidsim.applications.follow.follow_tables import Attempt
    from rapidsim.frames.euler import Convention
    from rapidsim.motion.robot.robot import Robot
    from rapidsim.motion.waypoints.plan import Plan
    from rapidsim.motion.waypoints.points import Points
    from rapidsim.motion.waypoints.solver_seeds import SeededSolve
    from rapidsim.report.run.summary import OutputFile

_WAYS = ("line", "spline", "joint", "joint-quintic")
_PROFILES = ("trapezoid", "scurve", "sigmoid", "quintic")
SHORTEST_DT, LONGEST_DT = 0.0001, 0.05
"""[s]"""


@value_class(frozen=True, slots=True)
class FollowRequest:
    """Options of a path to follow."""

    points_file: str | None = argument("[POINTS.csv]", required=False)
    line: tuple[float, ...] | None = shared(line_option)
    count: int = option(
        "--count",
        type=click.IntRange(2, 20_000),
        default=11,
        show_default=True,
        help="Points on the --line.",
    )
    robot: str = option(
        "--robot",
        metavar="NAME|FILE.urdf",
        default=DEFAULT_ROBOT,
        show_default=True,
        help="The arm; `rapidsim robots` lists them.",
    )
    tool: tuple[float, ...] = option(
        "--tool",
        type=numbers(3, 7),
        default="0,0,0",
        metavar="X,Y,Z[,Q1,Q2,Q3,Q4]",
        help="The TCP in the flange [mm]; without it, the flange itself.",
    )
    base: str = shared(base_option)
    convention: str = shared(convention_option)
    scale: float | None = shared(scale_option)
    path_kind: str = option(
        "--path",
        type=click.Choice(_WAYS),
        default="line",
        show_default=True,
        help="How the arm moves from point to point.",
    )
    profile: str = option(
        "--profile",
        type=click.Choice(_PROFILES),
        default="trapezoid",
        show_default=True,
        help="How the speed rises and falls.",
    )
    speed: float = option(
        "--speed",
        metavar="MM/S",
        type=POSITIVE,
        default=100.0,
        show_default=True,
        help="Speed of the TCP [mm/s].",
    )
    acceleration: float = option(
        "--acceleration",
        metavar="MM/S2",
        type=POSITIVE,
        default=1000.0,
        show_default=True,
        help="Acceleration along the path [mm/s2].",
    )
    turn_speed: float = option(
        "--turn-speed",
        metavar="DEG/S",
        type=POSITIVE,
        default=90.0,
        show_default=True,
        help="Limit where the tool turns more than it travels [deg/s].",
    )
    ease: float = option(
        "--ease",
        metavar="SHARE",
        type=NumberOption(0.0, 0.3),
        default=0.2,
        show_default=True,
        help="Share of the time at rest at either end of the sigmoid.",
    )
    via_speed: tuple[float, ...] | None = option(
        "--via-speed",
        type=numbers(),
        metavar="V|V1,V2,...",
        help="Joint speeds at the points between the ends, for joint-quintic [deg/s].",
    )
    min_radius: float = option(
        "--min-radius",
        metavar="MM",
        type=NumberOption(min=0.0),
        default=0.0,
        help="Minimum distance of the TCP from the origin of the base [mm].",
    )
    avoid: bool = option(
        "--avoid",
        is_flag=True,
        help="Route lines around that sphere; without it, they are rejected.",
    )
    conf: tuple[float, ...] | None = option(
        "--conf",
        type=numbers(4),
        metavar="CF1,CF4,CF6,CFX",
        help="Configuration at the first point; default: the one with the least movement.",
    )
    start: tuple[float, ...] | None = option(
        "--start",
        type=numbers(),
        metavar="A,B,...",
        help="Joints to start close to [deg; mm for a linear joint].",
    )
    skip_unreachable: bool = option(
        "--skip-unreachable", is_flag=True, help="Skip points that cannot be reached."
    )
    compare: bool = option(
        "--compare",
        is_flag=True,
        help="All four kinds of path side by side: poses solved, deviation, time.",
    )
    dt: tuple[float, ...] = option(
        "--dt",
        metavar="SECONDS[,SECONDS...]",
        type=numbers(),
        default="0.012",
        show_default=True,
        help="Time between samples [s]; several show how poses and solver time grow.",
    )
    starts: bool = option(
        "--starts",
        is_flag=True,
        help="Compare numerical solvers on the path, started from the previous pose and from 0.",
    )
    trace: str | None = option(
        "--trace", metavar="FILE", help="Write joints and TCP over time: .csv .parquet .json"
    )
    record: str | None = option(
        "--record", metavar="FILE.rrd", help="Write a recording for the rerun viewer."
    )
    plots: str | None = option(
        "--plots",
        metavar="DIR",
        help="Write pictures of path, joints, deviation, orientation; with --compare of each kind.",
    )
    output_format: str = shared(table_or_json)


@click.command(short_help="Follow points of a table in lines, splines or joint polynomials.")
@options_of(FollowRequest)
@terminal_options
def follow(options: FollowRequest) -> int:
    """Move an arm along the points of a table, and show how well it follows.

    POINTS.csv names its columns in the first line: x, y, z in mm in the robot's base frame, or with
    --base in the world, and q1 to q4, e1 to e3 (Euler angles) or pitch [deg] for the tool. `-`
    reads it from standard input; --line needs no file. The exit code is 1 if a point or the path
    between two points is out of reach, or a joint would have to exceed its speed.
    """
    from rapidsim.applications.follow.follow_steps import (
        attempt,
        attempt_all,
        prepared,
        started,
        unused,
    )
    from rapidsim.applications.follow.follow_steps import written as write_files
    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.frames.euler import Convention
    from rapidsim.motion.waypoints.plan import Way

    recording = new_recording(options.record) if options.record else None
    trace_file = new_trace(options.trace) if options.trace else None
    pictures = new_plots(options.plots) if options.plots else None
    writes_one = recording is not None or trace_file is not None
    _require_consistent(options, writes_one=writes_one, draws=pictures is not None)
    arm = open_robot(options.robot, options.scale)
    points = _points(options, len(arm.joints), Convention(options.convention))
    plan = _plan(options)
    task = prepared(_task_options(options, arm, plan), points)
    if not (current_terminal().quiet or options.compare):
        for remark in unused(task, plan):
            echo(f"note: {remark}", err=True)
    if len(options.dt) > 1:
        attempts = tuple(attempt(replace(task, dt=step), plan) for step in options.dt)
    else:
        attempts = attempt_all(task, plan, tuple(Way) if options.compare else (plan.kind,))
    title = "line" if options.points_file in (None, "-") else str(options.points_file)
    results = [one.result for one in attempts]
    files = write_files(results, title, recording, trace_file, pictures, task.requested)
    _report(options, task, attempts, files, started(results[0]) if options.starts else ())
    is_clean = task.all_reached and all(one.possible for one in attempts)
    return ExitCode.CLEAN if is_clean else ExitCode.FINDINGS


def _comparisons(options: FollowRequest) -> list[str]:
    """The options that request a comparison."""
    requested = {
        "--compare": options.compare,
        "--starts": options.starts,
        "several --dt": len(options.dt) > 1,
    }
    return [name for name, is_requested in requested.items() if is_requested]


def _require_consistent(options: FollowRequest, *, writes_one: bool, draws: bool) -> None:
    if options.starts:
        require("scipy", "--starts")
    if (options.points_file is None) == (options.line is None):
        raise InputError("give points either in a file or by --line X,Y,Z,X,Y,Z")
    for step in options.dt:
        # With longer steps a jump could not be distinguished from a fast axis.
        if not SHORTEST_DT <= step <= LONGEST_DT:
            raise InputError(f"--dt {step:g}: it must be {SHORTEST_DT:g} to {LONGEST_DT:g} s")
    comparisons = _comparisons(options)
    if len(comparisons) > 1:
        raise InputError(f"{' and '.join(comparisons)} exclude each other")
    if comparisons and (writes_one or (draws and not options.compare)):
        (name,) = comparisons
        verb = "write" if name.startswith("several") else "writes"
        only = "no files but pictures" if options.compare else "no files"
        raise InputError(f"{name} {verb} {only}", f"leave out {name}, or the files")
    if options.avoid and not options.min_radius:
        raise InputError("--avoid needs to know the sphere", "give its radius with --min-radius")


def _points(options: FollowRequest, joint_count: int, convention: Convention) -> Points:
    from rapidsim.motion.waypoints.points import Points
    from rapidsim.motion.waypoints.points_file import points_from_text

    if options.points_file is not None:
        text = _text(options.points_file)
        return points_from_text(text, options.points_file, joint_count, convention)
    assert options.line is not None
    return Points(line_points(options.line, options.count) / 1000.0, None)


def _plan(options: FollowRequest) -> Plan:
    from rapidsim.motion.waypoints.plan import Plan, Way
    from rapidsim.motion.waypoints.velocity_profiles import Profile

    return Plan(
        Way(options.path_kind),
        Profile(options.profile),
        speed=options.speed / 1000.0,
        acceleration=options.acceleration / 1000.0,
        turn_speed=radians(options.turn_speed),
        ease=options.ease,
        least_radius=options.min_radius / 1000.0,
        avoid=options.avoid,
    )


def _task_options(options: FollowRequest, arm: Robot, plan: Plan) -> FollowOptions:
    from rapidsim.applications.follow.follow_steps import FollowOptions
    from rapidsim.frames.euler import Convention

    return FollowOptions(
        arm,
        options.tool,
        world_from_base(options.base),
        plan,
        options.via_speed,
        options.start,
        options.conf,
        options.dt[0],
        options.skip_unreachable,
        Convention(options.convention),
    )


def _report(
    options: FollowRequest,
    task: PreparedPoints,
    attempts: tuple[Attempt, ...],
    files: Sequence[OutputFile],
    tried: Sequence[SeededSolve],
) -> None:
    from rapidsim.applications.follow.follow_json import compared_report, follow_report
    from rapidsim.applications.follow.follow_steps import render_result
    from rapidsim.applications.follow.follow_tables import starts_page

    terminal = current_terminal()
    if options.output_format == "json":
        if _comparisons(options) and not options.starts:
            report = json_of(compared_report(task.requested, attempts))
        else:
            report = json_of(follow_report(task.requested, attempts, tried))
        print_json(report)
    elif not terminal.quiet:
        terminal.show(render_result(task, attempts, files, compare=options.compare))
        if tried:
            echo("")
            terminal.show(starts_page(tried))


def _text(file: str) -> str:
    """The text of a file; `-` is standard input."""
    return decode(standard_input() if file == "-" else input_bytes(Path(file)))[0]
