"""`rapidsim points`: a table of points for `rapidsim follow`, random or on a line."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options import poses
from rapidsim.cli.options.declared import option, options_of, shared
from rapidsim.cli.options.numbers import numbers
from rapidsim.cli.options.poses import base_option, line_option, line_points, scale_option
from rapidsim.cli.terminal import current_terminal, echo, terminal_options
from rapidsim.files import InputError
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.frames.transform import Array


@value_class(frozen=True, slots=True)
class PointsOptions:
    """Options of points to reach."""

    shell: tuple[float, ...] | None = option(
        "--shell",
        type=numbers(2),
        metavar="R1,R2",
        help="Inner and outer radius of a spherical shell around the base [mm].",
    )
    postures: bool = option(
        "--postures", is_flag=True, help="Instead: the TCP at random joint values."
    )
    line: tuple[float, ...] | None = shared(line_option)
    count: int = option(
        "--count",
        type=click.IntRange(1, 20_000),
        default=8,
        show_default=True,
        help="Number of points.",
    )
    seed: int = option(
        "--seed",
        type=click.IntRange(min=0),
        default=0,
        show_default=True,
        help="Seed of the random numbers; the same seed gives the same points.",
    )
    robot: str | None = option(
        "--robot",
        metavar="NAME|FILE.urdf",
        help="Only points that this arm reaches within its limits.",
    )
    scale: float | None = shared(scale_option)
    attitude: str | None = option(
        "--attitude",
        type=click.Choice(["down", "random"]),
        help="With --robot: the tool straight down (default), or in any orientation.",
    )
    tool: tuple[float, ...] | None = option(
        "--tool",
        type=numbers(3, 7),
        metavar="X,Y,Z[,Q1,Q2,Q3,Q4]",
        help="The TCP in the flange [mm].",
    )
    base: str = shared(base_option)
    convention: str | None = option(
        "--convention",
        "--euler",
        type=click.Choice(poses.CONVENTIONS),
        help="Orientations as Euler angles e1,e2,e3 of this convention, not as quaternions.",
    )


@click.command(short_help="Print random points, for follow.")
@options_of(PointsOptions)
@terminal_options
def points(options: PointsOptions) -> int:
    """Print points as a table for `follow`.

    The points are random in a spherical shell around the base, or those of random joint values, or
    evenly spaced on a line. With --base they are in the world. The exit code is 1 if the arm
    reaches fewer points of the shell than requested.
    """
    from rapidsim.motion.waypoints.random_points import (
        posture_points,
        reached_points,
        shell_points,
    )

    if sum(map(bool, (options.shell, options.postures, options.line))) != 1:
        raise InputError("give exactly one of --shell, --postures and --line")
    if options.robot is None and (
        options.postures or options.tool or options.attitude or options.base != "floor"
    ):
        raise InputError("--postures, --attitude, --tool and --base need --robot")
    if options.scale is not None and options.robot is None:
        raise InputError("--scale is for a URDF file", "name it with --robot")
    if options.attitude and not options.shell:
        raise InputError("--attitude is for points of a --shell")
    if options.line is not None:
        if options.robot is not None:
            raise InputError("--line takes no robot", "`rapidsim follow --line` has one")
        _print(line_points(options.line, options.count), None, options.convention)
        return ExitCode.CLEAN
    inner, outer = options.shell or (0.0, 1.0)
    if not 0.0 <= inner < outer:
        raise InputError(f"--shell {inner:g},{outer:g}: the first radius must be the smaller one")
    if options.robot is None:
        _print(
            1000.0 * shell_points(inner / 1000.0, outer / 1000.0, options.count, options.seed),
            None,
            options.convention,
        )
        return ExitCode.CLEAN

    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.frames.transform import Transform, matrix_from_quaternion

    arm, stands, flange_from_tcp = (
        open_robot(options.robot, options.scale),
        poses.world_from_base(options.base),
        poses.tool(options.tool),
    )
    if options.postures:
        _, base_from_tcp = posture_points(arm, flange_from_tcp, options.count, options.seed)
    else:
        places, quaternions, drawn = reached_points(
            arm,
            flange_from_tcp,
            (inner / 1000.0, outer / 1000.0),
            options.count,
            options.seed,
            any_attitude=options.attitude == "random",
        )
        if not current_terminal().quiet:
            echo(f"note: {drawn} points were tried", err=True)
        base_from_tcp = Transform(matrix_from_quaternion(quaternions), places)
        if len(places) < options.count:
            echo(
                f"note: {arm.title} reached {len(places)} of them, not {options.count}; "
                "take another shell or --attitude random",
                err=True,
            )
    world_from_tcp = stands @ base_from_tcp
    _print(1000.0 * world_from_tcp.translation, world_from_tcp.rotation, options.convention)
    return ExitCode.CLEAN if len(world_from_tcp) == options.count else ExitCode.FINDINGS


def _print(places: Array, rotations: Array | None, convention: str | None) -> None:
    """A table of places (k, 3) [mm], and attitudes (k, 3, 3) where they are known."""
    import numpy as np

    from rapidsim.frames.euler import Convention, euler_from_rotation
    from rapidsim.frames.transform import quaternion_from_matrix

    rows = [[f"{value + 0.0:.3f}" for value in place] for place in places.tolist()]
    names = ["x", "y", "z"]
    if rotations is not None:
        if convention is None:
            names += ["q1", "q2", "q3", "q4"]
            attitudes = [[f"{q + 0.0:.9f}" for q in one]
                         for one in quaternion_from_matrix(rotations).tolist()]  # fmt: skip
        else:
            names += ["e1", "e2", "e3"]
            angles = np.degrees(euler_from_rotation(rotations, Convention(convention)))
            attitudes = [[f"{angle + 0.0:.6f}" for angle in one] for one in angles.tolist()]
        rows = [row + attitude for row, attitude in zip(rows, attitudes, strict=True)]
    echo(",".join(names))
    for row in rows:
        echo(",".join(row))
