"""`rapidsim robots`: the catalogue, and what is known of one arm."""

from __future__ import annotations

from math import degrees

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.outputs import new_plots
from rapidsim.cli.options.poses import scale_option
from rapidsim.cli.options.robot_choice import open_robot
from rapidsim.cli.terminal import (
    current_terminal,
    echo,
    print_json,
    table_or_json,
    terminal_options,
)
from rapidsim.files import InputError
from rapidsim.motion.robot.catalogue import aliases_of, robot_names
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.waypoints.workspace import workspace_of
from rapidsim.report.run.summary import OutputFile, files_text
from rapidsim.report.tables.kin_json import axis_tables_json
from rapidsim.report.tables.kin_tables import axis_tables_page
from rapidsim.report.tables.robot_tables import (
    catalogue_table,
    robot_page,
    workspace_json,
    workspace_page,
)


@click.command()
@click.argument("name", required=False)
@click.option(
    "--for",
    "program",
    metavar="PATH",
    help="Rank the arms by how well they suit the targets of a program.",
)
@click.option("--table", is_flag=True, help="Also show the DH table and the screw axes of the arm.")
@click.option(
    "--workspace",
    is_flag=True,
    help="Also show the volume that the arm reaches, and a section of it.",
)
@click.option("--plots", metavar="DIR", help="With --workspace: write a picture of the section.")
@scale_option
@table_or_json
@terminal_options
def robots(
    name: str | None,
    program: str | None,
    table: bool,
    workspace: bool,
    plots: str | None,
    scale: float | None,
    output_format: str,
) -> int:
    """List the robots, or show one with limits, speeds, reach and source.

    NAME is a name or alias of the catalogue, or a URDF file.

    With --for, the arms of ABB by how many of the targets of PATH they reach and hold in the
    stored configuration; a tie goes to the arm that comments, files, folders, stations or a
    backup name. For targets with seven axes, only arms with seven axes.
    """
    terminal = current_terminal()
    if program is not None:
        if name is not None or table or workspace or scale or plots:
            raise InputError("--for ranks all arms", "it goes with --format only")
        _show_ranking(program, output_format)
        return ExitCode.CLEAN
    if name is None and (table or workspace or scale):
        raise InputError("--table, --workspace and --scale are for one robot", "name it")
    if plots and not workspace:
        raise InputError("--plots needs --workspace", "it draws a section of the workspace")
    if name is not None:
        folder = new_plots(plots) if plots else None
        robot = open_robot(name, scale)
        short = aliases_of(robot.name)
        reached = workspace_of(robot) if workspace else None
        if output_format == "json":
            one = _as_json(robot, short)
            one |= axis_tables_json(robot) if table else {}
            one |= {} if reached is None else {"workspace": workspace_json(reached)}
            print_json(one)
        else:
            terminal.show(robot_page(robot, short))
            for page in (
                axis_tables_page(robot) if table else None,
                None if reached is None else workspace_page(reached),
            ):
                if page is not None:
                    echo("")
                    terminal.show(page)
        if isinstance(reached, str):
            return ExitCode.FINDINGS
        if folder and reached is not None:
            from rapidsim.plots.workspace_picture import write_workspace_plots

            write_workspace_plots(reached, folder)
            if output_format != "json" and not terminal.quiet:
                terminal.show(files_text([OutputFile(folder, "plots")]))
        return ExitCode.CLEAN
    # How each is solved is told where one is used, not in a list of all.
    listed = [(load_robot(robot), aliases_of(robot)) for robot in robot_names()]
    if output_format == "json":
        report = [_as_json(robot, short) for robot, short in listed]
        print_json({"schema": 1, "robots": report})
    else:
        terminal.show(catalogue_table(listed))
    return ExitCode.CLEAN


def _show_ranking(path: str, output_format: str) -> None:
    """Rank the arms for a program."""
    from rapidsim.jobs.best_arm import job_targets, names_of, texts_of
    from rapidsim.jobs.check_files import programs_of
    from rapidsim.jobs.job import job
    from rapidsim.jobs.robot_choice import DEFAULT_ROBOT
    from rapidsim.jobs.run_request import RunRequest
    from rapidsim.reach.arm_ranking import hints_of, rank_arms
    from rapidsim.report.tables.ranking_table import ranking_json, ranking_table

    found = job(RunRequest(paths=(path,)))
    targets = job_targets(found, programs_of(found))
    if not targets.count:
        raise InputError(
            f"no target of {path} is known without a run", "name an arm to check or run it"
        )
    ranked = rank_arms(targets, hints_of(texts_of(found), names_of(found)), DEFAULT_ROBOT)
    if output_format == "json":
        print_json(ranking_json(path, targets, ranked))
    else:
        current_terminal().show(ranking_table(targets, ranked))


def _as_json(robot: Robot, aliases: tuple[str, ...]) -> dict[str, object]:
    return {
        "name": robot.name,
        "title": robot.title,
        "maker": robot.maker,
        "aliases": list(aliases),
        "payload_kg": robot.payload_kg,
        "reach_mm": None if robot.reach_m is None else robot.reach_m * 1000.0,
        "axis_speeds_from": robot.axis_speeds_from,
        "joints": [
            {
                "name": joint.name,
                "slides": joint.slides,
                "lower_deg": degrees(joint.lower),
                "upper_deg": degrees(joint.upper),
                "max_speed_deg_s": _in_degrees(joint.max_speed),
                "max_acceleration_deg_s2": _in_degrees(joint.max_acceleration),
            }
            for joint in robot.joints
        ],
        "sources": list(robot.sources),
        "checks": list(robot.checks),
        "notes": list(robot.notes),
        "not_modelled": list(robot.not_modelled),
    }


def _in_degrees(value: float | None) -> float | None:
    return None if value is None else degrees(value)
