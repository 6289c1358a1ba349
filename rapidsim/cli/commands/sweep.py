"""`rapidsim sweep`: where could the robot stand?"""

from __future__ import annotations

from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.declared import argument, option, options_of
from rapidsim.cli.options.job_options import job_of
from rapidsim.cli.options.numbers import POSITIVE, PROCESSES
from rapidsim.cli.terminal import current_terminal, echo, terminal_options
from rapidsim.cli.tools.run_output import print_rejected
from rapidsim.cli.tools.sweep_output import swept_text
from rapidsim.extras import require
from rapidsim.files import InputError
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.values import value_class


def _shard(text: str) -> tuple[int, int]:
    first, _, of = text.partition("/")
    if not (first.isdecimal() and of.isdecimal() and 1 <= int(first) <= int(of)):
        raise click.BadParameter(f"{text!r} is not as in 1/4: part 1 of 4")
    return int(first), int(of)


@value_class(frozen=True, slots=True)
class SweepOptions:
    """Options of a sweep."""

    paths: tuple[str, ...] = argument("JOB.toml|PATH...", nargs=-1, required=True)
    varied: tuple[str, ...] = option(
        "--vary",
        metavar="KEY=FROM:TO:STEP",
        multiple=True,
        required=True,
        help="base.x, base.y, base.z [mm], base.rz, base.ry, base.rx [deg]; several form a grid.",
    )
    robot: str | None = option(
        "--robot", metavar="NAME|FILE.urdf", help="The arm, instead of the station's."
    )
    task: str | None = option("--task", metavar="NAME", help="Only this task, of several.")
    no_run: bool = option("--no-run", is_flag=True, help="Only check reach; run nothing.")
    max_time: float = option(
        "--max-time",
        metavar="SECONDS",
        type=POSITIVE,
        default=3600.0,
        show_default=True,
        help="End each run after this much simulated time.",
    )
    processes: int = option(
        "-j",
        type=PROCESSES,
        default=1,
        show_default=True,
        help="Number of parallel processes; auto is one for each core.",
    )
    shard: tuple[int, int] = option(
        "--shard",
        type=_shard,
        default="1/1",
        metavar="I/N",
        help="Part I of N equal parts, on one of N machines.",
    )
    out: str | None = option(
        "--out", metavar="FILE", help="Write a table of all variants: .parquet or .csv."
    )
    plots: str | None = option(
        "--plots", metavar="DIR", help="Write a picture of where the program works, and how well."
    )


@click.command(no_args_is_help=False)
@options_of(SweepOptions)
@terminal_options
def sweep(options: SweepOptions) -> int:
    """Try a program with the robot in many places.

    JOB.toml is a station file; the program is in the same folder, or given as further PATHs.
    Reach is checked for all places at once; where every target is reached in its stored
    configuration, the program is run. The exit code is 1 if there is no such place.
    """
    from rapidsim.export.variants import write_variants
    from rapidsim.jobs.running.run_files import ProgramRejectedError, loaded
    from rapidsim.jobs.running.sweep import axis_of
    from rapidsim.jobs.running.sweep import sweep as swept

    axes = [axis_of(text) for text in options.varied]
    if options.plots is not None:
        require("matplotlib", "--plots")
    ready = loaded(job_of(_request(options.paths, options.robot, options.task, options.max_time)))
    try:
        result = swept(
            ready, axes, shard=options.shard, run=not options.no_run, processes=options.processes
        )
    except ProgramRejectedError as rejected:
        print_rejected(ready, rejected.diagnostics, "table", current_terminal())
        return ExitCode.FINDINGS
    written = [] if options.out is None else [write_variants(result, Path(options.out))]
    if options.plots is not None:
        from rapidsim.plots.sweep_picture import write_sweep_picture

        written += write_sweep_picture(result, Path(options.plots))
    echo(swept_text(result, written))
    return ExitCode.CLEAN if result.works.any() else ExitCode.FINDINGS


def _request(
    paths: tuple[str, ...], robot: str | None, task: str | None, max_time: float
) -> RunRequest:
    """The request; one of the paths may be the station file."""
    stations = [path for path in paths if path.lower().endswith(".toml")]
    programs = tuple(path for path in paths if path not in stations)
    if len(stations) > 1:
        raise InputError(f"there are {len(stations)} station files", "name one")
    station = stations[0] if stations else None
    if station is not None and not Path(station).is_file():
        raise InputError(f"{station}: there is no such file")
    if station is not None and not programs:
        programs = (str(Path(station).parent),)
    return RunRequest(paths=programs, station=station, robot=robot, task=task, max_time_s=max_time)
