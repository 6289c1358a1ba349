"""`rapidsim follow`: points of a table as a trajectory, as the arm can run it, and how well."""

from __future__ import annotations

import json
from math import radians
from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.numbers import POSITIVE, Number, numbers
from rapidsim.cli.options.outputs import new_file, new_plots
from rapidsim.cli.terminal import current_terminal, say, table_or_json, terminal_options
from rapidsim.files import InputError, decode, input_bytes, standard_input
from rapidsim.jobs.choices import DEFAULT_ROBOT

_WAYS = ("line", "spline", "joint", "joint-quintic")
_PROFILES = ("trapezoid", "scurve", "sigmoid", "quintic")
_TRACES = (".csv", ".parquet", ".json")


@click.command()
@click.argument("points_file", metavar="POINTS.csv")
@click.option(
    "--robot",
    metavar="NAME|FILE.urdf",
    default=DEFAULT_ROBOT,
    show_default=True,
    help="The arm; `rapidsim robots` lists them.",
)
@click.option(
    "--tool",
    type=numbers(3, 7),
    default="0,0,0",
    metavar="X,Y,Z[,Q1,Q2,Q3,Q4]",
    help="The TCP in the flange [mm]; without it, the flange itself.",
)
@click.option(
    "--path",
    "way",
    type=click.Choice(_WAYS),
    default="line",
    show_default=True,
    help="How it goes from point to point.",
)
@click.option(
    "--profile",
    type=click.Choice(_PROFILES),
    default="trapezoid",
    show_default=True,
    help="How its speed rises and falls.",
)
@click.option(
    "--speed",
    metavar="MM/S",
    type=POSITIVE,
    default=100.0,
    show_default=True,
    help="Of the TCP [mm/s].",
)
@click.option(
    "--acceleration",
    metavar="MM/S2",
    type=POSITIVE,
    default=1000.0,
    show_default=True,
    help="Along the path [mm/s2].",
)
@click.option(
    "--turn-speed",
    metavar="DEG/S",
    type=POSITIVE,
    default=90.0,
    show_default=True,
    help="Where the tool turns more than it travels [deg/s].",
)
@click.option(
    "--ease",
    metavar="SHARE",
    type=Number(0.0, 0.3),
    default=0.2,
    show_default=True,
    help="Share of the time at rest at either end of the sigmoid.",
)
@click.option(
    "--via-speed",
    type=numbers(),
    metavar="V|V1,V2,...",
    help="Joint speeds at the points between the ends, for joint-quintic [deg/s].",
)
@click.option(
    "--min-radius",
    metavar="MM",
    type=Number(min=0.0),
    default=0.0,
    help="Distance from the origin of the base that the TCP keeps [mm].",
)
@click.option(
    "--avoid", is_flag=True, help="Lead lines around that sphere; without it they are refused."
)
@click.option(
    "--conf",
    type=numbers(4),
    metavar="CF1,CF4,CF6,CFX",
    help="Configuration at the first point; without it, the one that turns least.",
)
@click.option(
    "--start", type=numbers(), metavar="A,B,...", help="Joints that it begins near to [deg]."
)
@click.option(
    "--skip-unreachable", is_flag=True, help="Leave out points that are not reached, and go on."
)
@click.option(
    "--compare", is_flag=True, help="All four ways side by side: poses solved, deviation, time."
)
@click.option(
    "--dt",
    metavar="SECONDS",
    # With longer steps a jump could not be told from a fast axis.
    type=Number(0.0001, 0.05),
    default=0.012,
    show_default=True,
    help="Between samples [s].",
)
@click.option("--trace", metavar="FILE.csv|.parquet|.json", help="Write joints and TCP over time.")
@click.option("--record", metavar="FILE.rrd", help="Write a recording for the rerun viewer.")
@click.option("--plots", metavar="DIR", help="Write pictures of way, joints, deviation, attitude.")
@table_or_json
@terminal_options
def follow(
    points_file: str,
    robot: str,
    tool: tuple[float, ...],
    way: str,
    profile: str,
    speed: float,
    acceleration: float,
    turn_speed: float,
    ease: float,
    via_speed: tuple[float, ...] | None,
    min_radius: float,
    avoid: bool,
    conf: tuple[float, ...] | None,
    start: tuple[float, ...] | None,
    skip_unreachable: bool,
    compare: bool,
    dt: float,
    trace: str | None,
    record: str | None,
    plots: str | None,
    output_format: str,
) -> int:
    """Follow the points of a table, and say how well the arm can.

    POINTS.csv names its columns in the first line: x, y, z in mm in the robot's base frame, and
    q1 to q4 or pitch [deg] for the tool. `-` reads it from standard input. The exit code is 1 if a
    point or the way between is out of reach, or a joint would have to be too fast.
    """
    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.cli.tools.follow_steps import Given, attempt_all, prepared, shown, unused, written
    from rapidsim.motion.waypoints.plan import Plan, Way
    from rapidsim.motion.waypoints.points_file import points_from_text
    from rapidsim.motion.waypoints.velocity_profiles import Profile
    from rapidsim.report.tables.follow_json import compared_json, follow_json

    recording = new_file(record, (".rrd",)) if record else None
    trace_file = new_file(trace, _TRACES) if trace else None
    pictures = new_plots(plots) if plots else None
    if compare and (recording or trace_file or pictures):
        raise InputError("--compare writes no files", "leave out --compare, or the files")
    if avoid and not min_radius:
        raise InputError("--avoid needs to know the sphere", "name its radius with --min-radius")
    arm = open_robot(robot)
    points = points_from_text(_text(points_file), points_file, len(arm.joints))
    plan = Plan(
        Way(way),
        Profile(profile),
        speed=speed / 1000.0,
        acceleration=acceleration / 1000.0,
        turn_speed=radians(turn_speed),
        ease=ease,
        least_radius=min_radius / 1000.0,
        avoid=avoid,
    )
    given = Given(arm, tool, plan, via_speed, start, conf, dt, skip_unreachable)
    task = prepared(given, points)
    if not (current_terminal().quiet or compare):
        for remark in unused(task, plan):
            say(f"note: {remark}", err=True)
    attempts = attempt_all(task, plan, tuple(Way) if compare else (plan.way,))
    files = written(attempts[0].result, points_file, recording, trace_file, pictures)
    if output_format == "json":
        json_of = compared_json if compare else follow_json
        say(json.dumps(json_of(task.asked, attempts), indent=2, allow_nan=False))
    elif not current_terminal().quiet:
        current_terminal().show(shown(task, attempts, files, compare=compare))
    clean = task.all_reached and all(attempt.possible for attempt in attempts)
    return ExitCode.CLEAN if clean else ExitCode.FINDINGS


def _text(file: str) -> str:
    """The text of a file; `-` is standard input."""
    return decode(standard_input() if file == "-" else input_bytes(Path(file)))[0]
