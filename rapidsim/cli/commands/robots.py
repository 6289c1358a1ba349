"""`rapidsim robots`: the catalogue, and what is known of one arm."""

from __future__ import annotations

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.declared import argument, option, options_of, shared
from rapidsim.cli.options.new_files import new_plots
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
from rapidsim.jobs.running.picking_cycle import picking_cycle
from rapidsim.json_records.encoding import json_of
from rapidsim.motion.robot.catalogue import aliases_of, robot_names
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.workspace import workspace_of, wrist_workspace_of
from rapidsim.report.run.summary import OutputFile, files_text
from rapidsim.report.tables.axis_tables import axis_tables_page
from rapidsim.report.tables.robot_records import (
    CatalogueReport,
    axis_tables,
    robot_page_record,
    robot_record,
)
from rapidsim.report.tables.robot_tables import (
    catalogue_table,
    cycle_page,
    robot_page,
    workspace_page,
)
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class RobotsOptions:
    """Options of robots to show."""

    name: str | None = argument(required=False)
    program: str | None = option(
        "--for",
        metavar="PATH",
        help="Rank the arms by how well they suit the targets of a program.",
    )
    table: bool = option(
        "--table", is_flag=True, help="Also show the DH table and the screw axes of the arm."
    )
    workspace: bool = option(
        "--workspace",
        is_flag=True,
        help="Also show the volume that the arm reaches, and a section of it.",
    )
    cycle: bool = option(
        "--cycle",
        is_flag=True,
        help="Also run the picking cycle of data sheets, 25-300-25 mm, and show its time.",
    )
    plots: str | None = option(
        "--plots", metavar="DIR", help="With --workspace: write a picture of the section."
    )
    scale: float | None = shared(scale_option)
    output_format: str = shared(table_or_json)


@click.command()
@options_of(RobotsOptions)
@terminal_options
def robots(options: RobotsOptions) -> int:
    """List the robots, or show one with limits, speeds, reach and source.

    NAME is a name or alias of the catalogue, or a URDF file.

    With --for, ABB's arms are ranked by how many targets of PATH they reach, in the stored
    configuration; an arm that comments, files, folders, stations or a backup name wins a tie. For
    targets with seven axes, only arms with seven axes are ranked.
    """
    details = options.table or options.workspace or options.cycle or options.scale
    if options.program is not None:
        if options.name is not None or details or options.plots:
            raise InputError("--for ranks all arms", "it goes with --format only")
        _show_ranking(options.program, options.output_format)
        return ExitCode.CLEAN
    if options.plots and not options.workspace:
        raise InputError("--plots needs --workspace", "it draws a section of the workspace")
    if options.name is not None:
        return _show_robot(options.name, options)
    if details:
        raise InputError("--table, --workspace, --cycle and --scale are for one robot", "name it")
    _show_catalogue(options.output_format)
    return ExitCode.CLEAN


def _show_robot(name: str, options: RobotsOptions) -> ExitCode:
    terminal, is_json = current_terminal(), options.output_format == "json"
    folder = new_plots(options.plots) if options.plots else None
    robot = open_robot(name, options.scale)
    short = aliases_of(robot.name)
    reached = workspace_of(robot) if options.workspace else None
    of_wrist = wrist_workspace_of(robot) if options.workspace else None
    cycle = picking_cycle(robot) if options.cycle else None
    if is_json:
        tables = axis_tables(robot) if options.table else None
        print_json(json_of(robot_page_record(robot, short, tables, reached, of_wrist, cycle)))
    else:
        terminal.show(robot_page(robot, short))
        pages = [axis_tables_page(robot)] if options.table else []
        pages += [] if reached is None else [workspace_page(reached, of_wrist)]
        pages += [] if cycle is None else [cycle_page(robot, cycle)]
        for page in pages:
            echo("")
            terminal.show(page)
    if isinstance(reached, str):
        return ExitCode.FINDINGS
    if folder and reached is not None:
        from rapidsim.plots.workspace_picture import write_workspace_plots

        write_workspace_plots(reached, folder)
        if not is_json and not terminal.quiet:
            terminal.show(files_text([OutputFile(folder, "plots")]))
    return ExitCode.CLEAN


def _show_catalogue(output_format: str) -> None:
    # Notes on solvers are printed where an arm is used, not in the list.
    listed = [(load_robot(robot), aliases_of(robot)) for robot in robot_names()]
    if output_format == "json":
        report = CatalogueReport(tuple(robot_record(robot, short) for robot, short in listed))
        print_json(json_of(report))
    else:
        current_terminal().show(catalogue_table(listed))


def _show_ranking(path: str, output_format: str) -> None:
    """Rank the arms for a program."""
    from rapidsim.jobs.checking.best_arm import job_targets, names_of, texts_of
    from rapidsim.jobs.checking.check_files import programs_of
    from rapidsim.jobs.inputs.job import job
    from rapidsim.jobs.inputs.robot_choice import DEFAULT_ROBOT
    from rapidsim.jobs.inputs.run_request import RunRequest
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
