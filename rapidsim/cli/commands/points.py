"""`rapidsim points`: a table of points for `rapidsim follow`, at random."""

from __future__ import annotations

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.numbers import numbers
from rapidsim.cli.terminal import say, terminal_options
from rapidsim.files import InputError


@click.command()
@click.option(
    "--shell",
    type=numbers(2),
    required=True,
    metavar="R1,R2",
    help="Radii of the spheres around the base between which they lie [mm].",
)
@click.option(
    "--count", type=click.IntRange(1, 20_000), default=8, show_default=True, help="How many."
)
@click.option(
    "--seed",
    type=click.IntRange(min=0),
    default=0,
    show_default=True,
    help="Another number gives other points; the same gives the same.",
)
@terminal_options
def points(shell: tuple[float, ...], count: int, seed: int) -> int:
    """Print points in a shell around the base, evenly in its volume, as a table for `follow`."""
    from rapidsim.motion.waypoints.random_points import shell_points

    inner, outer = shell
    if not 0.0 <= inner < outer:
        raise InputError(f"--shell {inner:g},{outer:g}: the first radius must be the smaller one")
    say("x,y,z")
    for place in shell_points(inner, outer, count, seed).tolist():
        say(",".join(f"{value:.3f}" for value in place))
    return ExitCode.CLEAN
