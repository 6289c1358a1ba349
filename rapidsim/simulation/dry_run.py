"""Dry run that finds the first contact, at which the actual run ends, as motion supervision would.

Contacts are found only after a run. So a dry run is made first, in a copy of the home folder; the
actual run then ends at the contact and receives the answers recorded in the dry run.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from rapidsim.files import InputError
from rapidsim.findings.runs import CutOff
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End, Simulation


@contextmanager
def dry_run(options: RunOptions) -> Iterator[tuple[RunOptions, RunOptions]]:
    """Yield the options of a dry run without side effects, and those of the actual run.

    Raises:
        InputError: If the run has real sockets, which cannot be used twice.
    """
    if options.network is not None:
        raise InputError(
            "collisions.stop-on-collision: the run is made twice, which real sockets do not allow",
            "leave the key out, or the option that opens sockets",
        )
    first = again = options
    if options.geometry is not None:
        # Of its contacts only the time of the first is needed.
        first = replace(first, geometry=replace(options.geometry, has_depths=False))
    if options.answers is not None:
        given: list[str | None] = []
        ask = options.answers

        def noted(prompt: str) -> str | None:
            given.append(ask(prompt))
            return given[-1]

        def repeated(prompt: str) -> str | None:
            return given.pop(0) if given else ask(prompt)

        first, again = replace(first, answers=noted), replace(again, answers=repeated)
    with TemporaryDirectory(prefix="rapidsim-") as folder:
        if options.home is not None:
            home = Path(folder) / "home"
            if options.home.is_dir():
                shutil.copytree(options.home, home, symlinks=True)
            first = replace(first, home=home)
        yield first, again


def stopped_by_contact(simulation: Simulation) -> Simulation:
    """Turn the time limit at a contact into an error at which the run and its tasks end."""
    if simulation.end is not End.TIME_LIMIT:
        return simulation
    return replace(
        simulation,
        end=End.ERROR,
        tasks=tuple(
            replace(one, end=End.ERROR) if one.end is End.TIME_LIMIT else one
            for one in simulation.tasks
        ),
        diagnostics=tuple(
            one for one in simulation.diagnostics if not isinstance(one.violation, CutOff)
        ),
    )
