"""`rapidsim init`: write a first station file for a program, a folder or a backup."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.robot_choice import open_robot
from rapidsim.cli.terminal import current_terminal, echo, terminal_options
from rapidsim.files import InputError, relative_to_cwd, require_inside
from rapidsim.jobs.templates.station_template import station_template
from rapidsim.output_files import whole_file
from rapidsim.station.ci_file import PLACES, ci_text, ignored_lines, repository_of
from rapidsim.station.read import read_station
from rapidsim.station.station import find_station
from rapidsim.station.template import StationTemplate, draft_text
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class _CiFile:
    """A file for a service, not written yet."""

    path: Path
    text: str

    @classmethod
    def planned(cls, service: str, paths: Sequence[str], top: Path) -> _CiFile:
        """The file for some paths below a folder.

        Raises:
            InputError: If it is there already, or a path is not in the folder.
        """
        file = top / PLACES[service]
        require_inside([file], [top])
        if file.exists():
            raise InputError(f"{relative_to_cwd(file)} is there already, and is kept")
        named = []
        for path in paths:
            place = Path(os.path.realpath(path))
            if path == "-" or not place.is_relative_to(top):
                raise InputError(f"--ci: {path} is not in {top}")
            named.append(place.relative_to(top).as_posix())
        return cls(file, ci_text(service, named))

    def write(self) -> None:
        """Write it."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(self.path) as temporary:
            temporary.write_text(self.text, encoding="utf-8")


@click.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option("--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them.")
@click.option(
    "--ci",
    "service",
    type=click.Choice(tuple(PLACES)),
    help="Also write a file with which this service checks, runs and compares the programs.",
)
@terminal_options
def init(paths: tuple[str, ...], robot: str | None, service: str | None) -> int:
    """Write `rapidsim.toml` with robot, tasks and signals, as far as they are known.

    PATH is a module, a .pgf program file, a folder or a controller backup, or a folder with
    SYS.cfg, EIO.cfg and MOC.cfg. If a folder has several mains, each becomes a task. The file is
    written next to the modules, or into the backup; an existing one is kept, and with --ci only the
    file of the service is written.

    It has comments with further entries: stimuli for inputs that nothing sets,
    bodies for collision checks. Suggested lines for .gitignore are printed.
    """
    if robot is not None and not robot.lower().endswith(".urdf"):
        robot = open_robot(robot).name
    found = station_template(paths, robot)
    shown = relative_to_cwd(found.path)
    is_kept = found.path.exists()
    if is_kept and service is None:
        raise InputError(
            f"{shown} is there already, and is kept", "edit it, or move it out of the way"
        )
    folder = Path(os.path.realpath(found.path.parent))
    repository = repository_of(folder)
    ci_file = None if service is None else _CiFile.planned(service, paths, repository or folder)
    if not is_kept:
        with whole_file(found.path) as temporary:
            temporary.write_text(draft_text(found.draft), encoding="utf-8")
    if ci_file is not None:
        ci_file.write()
    # What is written can be read: a mistake here is ours.
    read_station(found.path)
    if not current_terminal().quiet:
        echo(f"Kept: {shown}" if is_kept else f"Written: {shown} ({_counted(found.draft)})")
        if ci_file is not None:
            echo(f"Written: {relative_to_cwd(ci_file.path)}")
        if repository is not None and (lines := ignored_lines(repository)):
            echo(f"For .gitignore: {' '.join(lines)}")
        for lack in () if is_kept else found.lacks:
            echo(f"note: {lack}", err=True)
        if not is_kept and (above := find_station([str(found.path.parent.parent)])):
            echo(f"{above} no longer applies to the files next to {shown}.")
    return ExitCode.CLEAN


def _counted(draft: StationTemplate) -> str:
    """Description of the file's contents."""
    counts = ((len(draft.tasks), "task"), (len(draft.signals), "signal"))
    words = [f"{count} {noun}{'s' * (count != 1)}" for count, noun in counts if count]
    return ", ".join(words) or "nothing beyond the backup or the defaults"
