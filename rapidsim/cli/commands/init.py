"""`rapidsim init`: write a first station file for a program, a folder or a backup."""

from __future__ import annotations

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.robot_choice import open_robot
from rapidsim.cli.terminal import current_terminal, say, terminal_options
from rapidsim.files import InputError, seen_from_here
from rapidsim.jobs.draft import draft_for
from rapidsim.output_files import whole_file
from rapidsim.station.draft import Draft, draft_text
from rapidsim.station.read import read_station
from rapidsim.station.station import find_station


@click.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option("--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them.")
@terminal_options
def init(paths: tuple[str, ...], robot: str | None) -> int:
    """Write `rapidsim.toml` with robot, tasks and signals, as far as they are known.

    PATH is a module, a .pgf program file, a folder or a controller backup, or a folder with
    SYS.cfg, EIO.cfg and MOC.cfg. If a folder has several mains, each becomes a task. The file is
    written next to the modules, or into the backup; an existing one is kept.
    """
    if robot is not None and not robot.lower().endswith(".urdf"):
        robot = open_robot(robot).name
    found = draft_for(paths, robot)
    shown = seen_from_here(found.path)
    if found.path.exists():
        raise InputError(
            f"{shown} is there already, and is kept", "edit it, or move it out of the way"
        )
    with whole_file(found.path) as temporary:
        temporary.write_text(draft_text(found.draft), encoding="utf-8")
    # What is written can be read: a mistake here is ours.
    read_station(found.path)
    if not current_terminal().quiet:
        say(f"Written: {shown} ({_counted(found.draft)})")
        for lack in found.lacks:
            say(f"note: {lack}", err=True)
        if above := find_station([str(found.path.parent.parent)]):
            say(f"{above} no longer applies to what is beside {shown}.")
    return ExitCode.CLEAN


def _counted(draft: Draft) -> str:
    """What stands in the file, in words."""
    counts = ((len(draft.tasks), "task"), (len(draft.signals), "signal"))
    words = [f"{count} {noun}{'s' * (count != 1)}" for count, noun in counts if count]
    return ", ".join(words) or "nothing beyond the backup or the defaults"
