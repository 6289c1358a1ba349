"""`rapidsim kin`: forward and inverse kinematics and the Jacobian of one pose."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import TYPE_CHECKING, Any, TypeVar

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options import poses
from rapidsim.cli.options.numbers import ANY_NUMBER, numbers
from rapidsim.cli.options.poses import (
    base_option,
    convention_option,
    euler_option,
    posture_options,
    scale_option,
)
from rapidsim.cli.terminal import (
    current_terminal,
    echo,
    print_json,
    table_or_json,
    terminal_options,
)
from rapidsim.extras import require
from rapidsim.files import InputError
from rapidsim.jobs.robot_choice import DEFAULT_ROBOT

if TYPE_CHECKING:
    from rapidsim.frames.transform import Array, Transform
    from rapidsim.motion.robot.robot import Robot
    from rapidsim.report.tables.kin_json import SearchCost

SEARCHES = ("lm", "bfgs", "trf")

Command = TypeVar("Command", bound=Callable[..., Any])


_joints_option = click.option(
    "--joints",
    type=numbers(),
    required=True,
    metavar="A,B,...",
    help="Joints [deg; mm for a linear joint].",
)


def _common(command: Command) -> Command:
    """The options of all three commands."""
    for option in (
        terminal_options,
        table_or_json,
        base_option,
        convention_option,
        posture_options,
        scale_option,
        click.option(
            "--tool",
            type=numbers(3, 7),
            metavar="X,Y,Z[,Q1,Q2,Q3,Q4]",
            help="The TCP in the flange [mm]; without it, the flange itself.",
        ),
        click.option(
            "--robot",
            metavar="NAME|FILE.urdf",
            default=DEFAULT_ROBOT,
            show_default=True,
            help="The arm; `rapidsim robots` lists them.",
        ),
    ):
        command = option(command)
    return command


@click.group(invoke_without_command=True)
@terminal_options
@click.pass_context
def kin(context: click.Context) -> int | None:
    """Forward and inverse kinematics and the Jacobian of one pose.

    Positions are in mm in the robot's base frame, or with --base in the world; angles in degrees,
    quaternions scalar first.
    """
    if context.invoked_subcommand is None:
        echo(context.get_help())
        return ExitCode.USAGE
    return None


@kin.command()
@_joints_option
@click.option(
    "--tables", is_flag=True, help="Also show the matrix of each link, and the arm's tables."
)
@_common
def fk(
    joints: tuple[float, ...],
    tables: bool,
    robot: str,
    scale: float | None,
    tool: tuple[float, ...] | None,
    base: str,
    convention: str,
    record: str | None,
    plots: str | None,
    view: bool,
    output_format: str,
) -> int:
    """Show where the flange is, or the TCP, and every link."""
    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.cli.tools import kin_steps
    from rapidsim.frames.euler import Convention
    from rapidsim.motion.configurations.postures import Posture, Postures
    from rapidsim.report.tables.kin_json import forward_json
    from rapidsim.report.tables.kin_tables import forward_page

    arm = open_robot(robot, scale)
    files = kin_steps.outputs(record, plots, view, f"{arm.name}-fk.rrd")
    angles = _joints(arm, joints)
    shown = Postures(
        arm,
        poses.world_from_base(base),
        poses.tool(tool),
        (Posture(angles, "joints"),),
        f"{arm.title} at {_list(joints)} {arm.units()}",
    )
    if output_format == "json":
        print_json(forward_json(shown, Convention(convention)))
    else:
        current_terminal().show(forward_page(shown, Convention(convention), tables=tables))
    kin_steps.write(shown, files, quiet=output_format == "json")
    return ExitCode.CLEAN


@kin.command()
@click.option(
    "--position",
    type=numbers(3),
    required=True,
    metavar="X,Y,Z",
    help="Position of the TCP in base [mm].",
)
@click.option(
    "--quaternion",
    type=numbers(4),
    metavar="Q1,Q2,Q3,Q4",
    help="Orientation of the TCP, scalar first.",
)
@euler_option
@click.option(
    "--pitch",
    type=ANY_NUMBER,
    metavar="DEG",
    help="Instead: the tool in the vertical plane through axis 1, at this angle above horizontal.",
)
@click.option(
    "--roll",
    type=ANY_NUMBER,
    metavar="DEG",
    default=0.0,
    help="With --pitch: rotation about the tool [deg].",
)
@click.option(
    "--conf",
    type=numbers(4),
    metavar="CF1,CF4,CF6,CFX",
    help="Only solutions in this configuration.",
)
@click.option(
    "--all",
    "everything",
    is_flag=True,
    help="Include whole turns and solutions outside the limits.",
)
@click.option(
    "--solver",
    type=click.Choice(["auto", "analytic", *SEARCHES]),
    default="auto",
    show_default=True,
    help="auto: closed form where the arm has one, else numerical; or a SciPy solver by name.",
)
@_common
def ik(
    position: tuple[float, ...],
    quaternion: tuple[float, ...] | None,
    euler: tuple[float, ...] | None,
    pitch: float | None,
    roll: float,
    conf: tuple[float, ...] | None,
    everything: bool,
    solver: str,
    robot: str,
    scale: float | None,
    tool: tuple[float, ...] | None,
    base: str,
    convention: str,
    record: str | None,
    plots: str | None,
    view: bool,
    output_format: str,
) -> int:
    """Show the joints that bring the TCP to a pose.

    One solution per branch within the joint limits, in the turn nearest to joint values 0. The exit
    code is 1 if there is none.
    """
    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.cli.tools import kin_steps
    from rapidsim.motion.configurations.confdata import has_branches
    from rapidsim.motion.configurations.pose_solutions import solve_pose, solve_pose_as
    from rapidsim.motion.configurations.postures import Postures
    from rapidsim.report.tables.kin_json import inverse_json
    from rapidsim.report.tables.kin_tables import inverse_page

    arm = open_robot(robot, scale)
    files = kin_steps.outputs(record, plots, view, f"{arm.name}-ik.rrd")
    closed_form = has_branches(arm.kinematics)
    stands, flange_from_tcp = poses.world_from_base(base), poses.tool(tool)
    asked = poses.asked_pose(position, quaternion, euler, convention, pitch, roll)
    pose = stands.inverse() @ asked @ flange_from_tcp.inverse()
    searched: SearchCost | None = None
    if solver in SEARCHES:
        if conf is not None or everything:
            raise InputError(
                f"--solver {solver} finds one solution, in no configuration in particular",
                "leave out --conf and --all, or use --solver analytic",
            )
        name = solver
        found, searched = _search(arm, pose, solver)
    elif solver == "analytic" and not closed_form:
        raise InputError(f"{arm.name} has no closed form", "use --solver auto, lm, bfgs or trf")
    else:
        name = "analytic" if closed_form else "damped-least-squares"
        if conf is None:
            found = solve_pose(arm, pose, everything=everything)
        elif not closed_form:
            raise InputError(f"the solutions of {arm.name} are not told apart by confdata")
        else:
            found = solve_pose_as(arm, pose, _whole(conf))
    if output_format == "json":
        print_json(inverse_json(arm, name, found, searched))
    else:
        current_terminal().show(inverse_page(arm, name, asked, found, searched))
    if found.solutions:
        title = f"{arm.title} with the TCP at {_list(position)} mm"
        rows = kin_steps.solved_postures(found, arm.kinematics.turns)
        shown = Postures(arm, stands, flange_from_tcp, rows, title)
        kin_steps.write(shown, files, quiet=output_format == "json")
    return ExitCode.CLEAN if found.reason is None else ExitCode.FINDINGS


@kin.command(short_help="Show how joints move the TCP, and how close singularities are.")
@_joints_option
@click.option(
    "--twist",
    type=numbers(6),
    metavar="VX,VY,VZ,WX,WY,WZ",
    help="Velocity of the TCP in base [mm/s, deg/s]; shows the joint speeds it needs.",
)
@_common
def jacobian(
    joints: tuple[float, ...],
    twist: tuple[float, ...] | None,
    robot: str,
    scale: float | None,
    tool: tuple[float, ...] | None,
    base: str,
    convention: str,
    record: str | None,
    plots: str | None,
    view: bool,
    output_format: str,
) -> int:
    """Show how joint speeds move the TCP, and which singularity is near."""
    import numpy as np

    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.cli.tools import kin_steps
    from rapidsim.motion.configurations.postures import Posture, Postures
    from rapidsim.motion.configurations.singularities import differential
    from rapidsim.report.tables.kin_json import jacobian_json
    from rapidsim.report.tables.kin_tables import jacobian_page

    del convention
    arm = open_robot(robot, scale)
    files = kin_steps.outputs(record, plots, view, f"{arm.name}-jacobian.rrd")
    angles, flange_from_tcp = _joints(arm, joints), poses.tool(tool)
    found = differential(arm.kinematics, angles, flange_from_tcp)
    wanted: Array | None = None
    if twist is not None:
        wanted = np.array([*(v / 1000.0 for v in twist[:3]), *np.radians(twist[3:])])
    if output_format == "json":
        print_json(jacobian_json(arm, found, wanted))
    else:
        current_terminal().show(jacobian_page(arm, found, wanted))
    shown = Postures(
        arm,
        poses.world_from_base(base),
        flange_from_tcp,
        (Posture(angles, "joints"),),
        f"{arm.title} at {_list(joints)} {arm.units()}",
        found,
    )
    kin_steps.write(shown, files, quiet=output_format == "json")
    return ExitCode.CLEAN


def _joints(arm: Robot, degrees: tuple[float, ...]) -> Array:
    """Joints [rad]; those outside the limits are noted on stderr."""
    import numpy as np

    from rapidsim.motion.configurations.reachability import Unreachable, limit_excess

    if len(degrees) != len(arm.joints):
        raise InputError(
            f"--joints has {len(degrees)} numbers, but {arm.name} has {len(arm.joints)} joints"
        )
    angles: Array = np.radians(np.array(degrees, dtype=np.float64))
    for number, excess in enumerate(limit_excess(arm, angles).tolist(), start=1):
        if excess and not current_terminal().quiet:
            measure = arm.joints[number - 1].measure
            message = Unreachable(0.0, joint=number, excess=excess, measure=measure).message
            echo(f"note: {message}", err=True)
    return angles


def _list(values: tuple[float, ...]) -> str:
    return f"({', '.join(f'{value:g}' for value in values)})"


def _whole(conf: tuple[float, ...]) -> tuple[int, ...]:
    if any(value != int(value) for value in conf):
        raise InputError("--conf takes whole numbers: cf1, cf4, cf6 and cfx")
    return tuple(int(value) for value in conf)


def _search(arm: Robot, pose: Transform, method: str) -> tuple[Any, SearchCost]:
    """Search with one of SciPy's solvers."""
    require("scipy", f"--solver {method}")
    from rapidsim.motion.configurations.pose_solutions import PoseSolutions, solution
    from rapidsim.motion.configurations.reachability import Unreachable, unreachable_reason
    from rapidsim.motion.configurations.scipy_solvers import TOLERANCE, search
    from rapidsim.report.tables.kin_json import SearchCost

    began = perf_counter()
    found = search(arm, pose, method)
    seconds = perf_counter() - began
    searched = SearchCost(found.starts, found.iterations, TOLERANCE, seconds)
    if found.solved:
        return PoseSolutions((solution(arm, pose, found.joints),), None), searched
    known = unreachable_reason(arm, pose)
    came = Unreachable(found.distance, tilt=found.angle, searched=True)
    if found.distance <= TOLERANCE and found.angle <= TOLERANCE:
        why = f"{method} found joints outside the limits only"
        nearest = (solution(arm, pose, found.joints),)
        return PoseSolutions(nearest, known.message if known else why), searched
    return PoseSolutions((), known.message if known else came.message), searched
