"""`rapidsim robots`: the catalogue, and what is known of one arm."""

from __future__ import annotations

import json
from math import degrees

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.robot_choice import open_robot
from rapidsim.cli.terminal import current_terminal, say, table_or_json, terminal_options
from rapidsim.motion.robot.catalogue import aliases_of, robot_names
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.report.tables.robot_tables import catalogue_table, robot_page


@click.command()
@click.argument("name", required=False)
@table_or_json
@terminal_options
def robots(name: str | None, output_format: str) -> int:
    """List the robots, or show one with limits, speeds, reach and source.

    NAME is a name or alias of the catalogue, or a URDF file.
    """
    terminal = current_terminal()
    if name is not None:
        robot = open_robot(name)
        short = aliases_of(robot.name)
        if output_format == "json":
            say(json.dumps(_as_json(robot, short), indent=2, allow_nan=False))
        else:
            terminal.show(robot_page(robot, short))
        return ExitCode.CLEAN
    # How each is solved is told where one is used, not in a list of all.
    listed = [(load_robot(robot), aliases_of(robot)) for robot in robot_names()]
    if output_format == "json":
        report = [_as_json(robot, short) for robot, short in listed]
        say(json.dumps({"schema": 1, "robots": report}, indent=2, allow_nan=False))
    else:
        terminal.show(catalogue_table(listed))
    return ExitCode.CLEAN


def _as_json(robot: Robot, aliases: tuple[str, ...]) -> dict[str, object]:
    return {
        "name": robot.name,
        "title": robot.title,
        "maker": robot.maker,
        "aliases": list(aliases),
        "payload_kg": robot.payload_kg,
        "reach_mm": None if robot.reach_m is None else robot.reach_m * 1000.0,
        "joints": [
            {
                "name": joint.name,
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
