"""`rapidsim kin`: forward and inverse kinematics and the Jacobian of one pose."""

from __future__ import annotations

from collections.abc import Callable
from math import degrees
from time import perf_counter
from typing import TYPE_CHECKING, Any, TypeVar

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options import poses
from rapidsim.cli.options.declared import option, options_of, shared
from rapidsim.cli.options.numbers import ANY_NUMBER, numbers
from rapidsim.cli.options.poses import (
    base_option,
    convention_option,
    euler_option,
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
from rapidsim.jobs.inputs.robot_choice import DEFAULT_ROBOT
from rapidsim.json_records.encoding import json_of
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.applications.kin.kin_json import SearchCost
    from rapidsim.frames.transform import Array, Transform
    from rapidsim.motion.robot.robot import Robot

SEARCHES = ("lm", "bfgs", "trf")

Command = TypeVar("Command", bound=Callable[..., Any])


_joints_option = click.option(
    "--joints",
    type=numbers(),
    required=True,
    metavar="A,B,...",
    help="Joints [deg; mm for a linear joint].",
)


@value_class(frozen=True, slots=True)
class SetupOptions:
    """Options of the arm, its tool and base, and the output."""

    robot: str = option(
        "--robot",
        metavar="NAME|FILE.urdf",
        default=DEFAULT_ROBOT,
        show_default=True,
        help="The arm; `rapidsim robots` lists them.",
    )
    tool: tuple[float, ...] | None = option(
        "--tool",
        type=numbers(3, 7),
        metavar="X,Y,Z[,Q1,Q2,Q3,Q4]",
        help="The TCP in the flange [mm]; without it, the flange itself.",
    )
    scale: float | None = shared(scale_option)
    record: str | None = option(
        "--record", metavar="FILE.rrd", help="Write a recording of the arm."
    )
    plots: str | None = option(
        "--plots", metavar="DIR", help="Write pictures of arm, frames and matrix."
    )
    view: bool = option("--view", is_flag=True, help="Open the recording in the rerun viewer.")
    convention: str = shared(convention_option)
    base: str = shared(base_option)
    output_format: str = shared(table_or_json)


@click.group(
    invoke_without_command=True,
    short_help="Forward and inverse kinematics and Jacobian of one pose.",
)
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


@value_class(frozen=True, slots=True)
class ForwardOptions:
    """Options of joints."""

    joints: tuple[float, ...] = shared(_joints_option)
    tables: bool = option(
        "--tables",
        is_flag=True,
        help="Also show the matrices of the links, T(k-1,k) included, and the arm's tables.",
    )


@kin.command()
@options_of(ForwardOptions, "options")
@options_of(SetupOptions, "setup")
@terminal_options
def fk(options: ForwardOptions, setup: SetupOptions) -> int:
    """Show where the flange is, or the TCP, and every link."""
    from rapidsim.applications.kin import kin_steps
    from rapidsim.applications.kin.kin_json import forward_report
    from rapidsim.applications.kin.kin_tables import forward_page
    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.frames.euler import Convention
    from rapidsim.motion.configurations.postures import Posture, Postures

    arm = open_robot(setup.robot, setup.scale)
    files = kin_steps.outputs(setup.record, setup.plots, setup.view, f"{arm.name}-fk.rrd")
    angles = _joints(arm, options.joints)
    shown = Postures(
        arm,
        poses.world_from_base(setup.base),
        poses.tool(setup.tool),
        (Posture(angles, "joints"),),
        f"{arm.title} at {_list(options.joints)} {arm.units()}",
    )
    if setup.output_format == "json":
        print_json(json_of(forward_report(shown, Convention(setup.convention))))
    else:
        current_terminal().show(
            forward_page(shown, Convention(setup.convention), tables=options.tables)
        )
    kin_steps.write(shown, files, quiet=setup.output_format == "json")
    return ExitCode.CLEAN


@value_class(frozen=True, slots=True)
class InverseOptions:
    """Options of a pose to reach."""

    position: tuple[float, ...] = option(
        "--position",
        type=numbers(3),
        required=True,
        metavar="X,Y,Z",
        help="Position of the TCP in base [mm].",
    )
    quaternion: tuple[float, ...] | None = option(
        "--quaternion",
        type=numbers(4),
        metavar="Q1,Q2,Q3,Q4",
        help="Orientation of the TCP, scalar first.",
    )
    euler: tuple[float, ...] | None = shared(euler_option)
    pitch: float | None = option(
        "--pitch",
        type=ANY_NUMBER,
        metavar="DEG",
        help="Instead: the tool in the vertical plane through axis 1, at this angle above "
        "horizontal.",
    )
    roll: float = option(
        "--roll",
        type=ANY_NUMBER,
        metavar="DEG",
        default=0.0,
        help="With --pitch: rotation about the tool [deg].",
    )
    conf: tuple[float, ...] | None = option(
        "--conf",
        type=numbers(4),
        metavar="CF1,CF4,CF6,CFX",
        help="Only solutions in this configuration.",
    )
    everything: bool = option(
        "--all", is_flag=True, help="Include whole turns and solutions outside the limits."
    )
    solver: str = option(
        "--solver",
        type=click.Choice(["auto", "analytic", *SEARCHES]),
        default="auto",
        show_default=True,
        help="auto: closed form where the arm has one, else numerical; or a SciPy solver by name.",
    )


@kin.command()
@options_of(InverseOptions, "options")
@options_of(SetupOptions, "setup")
@terminal_options
def ik(options: InverseOptions, setup: SetupOptions) -> int:
    """Show the joints that bring the TCP to a pose.

    One solution per branch within the joint limits, in the turn nearest to joint values 0. The exit
    code is 1 if there is none.
    """
    from rapidsim.applications.kin import kin_steps
    from rapidsim.applications.kin.kin_json import inverse_report
    from rapidsim.applications.kin.kin_tables import inverse_page
    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.motion.configurations.confdata import has_branches
    from rapidsim.motion.configurations.pose_solutions import solve_pose, solve_pose_as
    from rapidsim.motion.configurations.postures import Postures

    arm = open_robot(setup.robot, setup.scale)
    files = kin_steps.outputs(setup.record, setup.plots, setup.view, f"{arm.name}-ik.rrd")
    closed_form = has_branches(arm.kinematics)
    stands, flange_from_tcp = poses.world_from_base(setup.base), poses.tool(setup.tool)
    asked = kin_steps.requested_pose(
        options.position,
        options.quaternion,
        options.euler,
        setup.convention,
        options.pitch,
        options.roll,
    )
    pose = stands.inverse() @ asked @ flange_from_tcp.inverse()
    searched: SearchCost | None = None
    if options.solver in SEARCHES:
        if options.conf is not None or options.everything:
            raise InputError(
                f"--solver {options.solver} finds one solution, in no configuration in particular",
                "leave out --conf and --all, or use --solver analytic",
            )
        name = options.solver
        found, searched = _search(arm, pose, options.solver)
    elif options.solver == "analytic" and not closed_form:
        raise InputError(f"{arm.name} has no closed form", "use --solver auto, lm, bfgs or trf")
    else:
        name = "analytic" if closed_form else "damped-least-squares"
        if options.conf is None:
            found = solve_pose(arm, pose, everything=options.everything)
        elif not closed_form:
            raise InputError(f"confdata does not distinguish the solutions of {arm.name}")
        else:
            found = solve_pose_as(arm, pose, _whole(options.conf))
    if setup.output_format == "json":
        print_json(json_of(inverse_report(arm, name, found, searched)))
    else:
        current_terminal().show(inverse_page(arm, name, asked, found, searched))
    if found.solutions:
        title = f"{arm.title} with the TCP at {_list(options.position)} mm"
        rows = kin_steps.solved_postures(found, arm.kinematics.turns)
        shown = Postures(arm, stands, flange_from_tcp, rows, title)
        kin_steps.write(shown, files, quiet=setup.output_format == "json")
    return ExitCode.CLEAN if found.reason is None else ExitCode.FINDINGS


@value_class(frozen=True, slots=True)
class JacobianOptions:
    """Options of a posture and its motion."""

    joints: tuple[float, ...] = shared(_joints_option)
    twist: tuple[float, ...] | None = option(
        "--twist",
        type=numbers(6),
        metavar="VX,VY,VZ,WX,WY,WZ",
        help="Velocity of the TCP in base [mm/s, deg/s]; shows the joint speeds it needs.",
    )


@kin.command(short_help="Show how joints move the TCP, and how close singularities are.")
@options_of(JacobianOptions)
@options_of(SetupOptions, "setup")
@terminal_options
def jacobian(options: JacobianOptions, setup: SetupOptions) -> int:
    """Show how joint speeds move the TCP, and which singularity is near."""
    import numpy as np

    from rapidsim.applications.kin import kin_steps
    from rapidsim.applications.kin.kin_json import jacobian_report
    from rapidsim.applications.kin.kin_tables import jacobian_page
    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.motion.configurations.postures import Posture, Postures
    from rapidsim.motion.configurations.singularities import differential

    arm = open_robot(setup.robot, setup.scale)
    files = kin_steps.outputs(setup.record, setup.plots, setup.view, f"{arm.name}-jacobian.rrd")
    angles, flange_from_tcp = _joints(arm, options.joints), poses.tool(setup.tool)
    found = differential(arm.kinematics, angles, flange_from_tcp)
    wanted: Array | None = None
    if options.twist is not None:
        wanted = np.array(
            [*(v / 1000.0 for v in options.twist[:3]), *np.radians(options.twist[3:])]
        )
    if setup.output_format == "json":
        print_json(json_of(jacobian_report(arm, found, wanted)))
    else:
        current_terminal().show(jacobian_page(arm, found, wanted))
    shown = Postures(
        arm,
        poses.world_from_base(setup.base),
        flange_from_tcp,
        (Posture(angles, "joints"),),
        f"{arm.title} at {_list(options.joints)} {arm.units()}",
        found,
    )
    kin_steps.write(shown, files, quiet=setup.output_format == "json")
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
    from rapidsim.applications.kin.kin_json import SearchCost
    from rapidsim.motion.configurations.pose_solutions import PoseSolutions, solution
    from rapidsim.motion.configurations.reachability import Unreachable, unreachable_reason
    from rapidsim.motion.configurations.scipy_solvers import TOLERANCE, search

    began = perf_counter()
    found = search(arm, pose, method)
    seconds = perf_counter() - began
    searched = SearchCost(
        found.starts, found.iterations, TOLERANCE * 1000.0, degrees(TOLERANCE), seconds
    )
    if found.solved:
        return PoseSolutions((solution(arm, pose, found.joints),), None), searched
    known = unreachable_reason(arm, pose)
    came = Unreachable(found.distance, tilt=found.angle, searched=True)
    if found.distance <= TOLERANCE and found.angle <= TOLERANCE:
        why = f"{method} found joints outside the limits only"
        nearest = (solution(arm, pose, found.joints),)
        return PoseSolutions(nearest, known.message if known else why), searched
    return PoseSolutions((), known.message if known else came.message), searched
