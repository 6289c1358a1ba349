"""A picture of the path of a run, for agents that can see."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from rapidsim.agents.programs import sent_program
from rapidsim.extras import require
from rapidsim.files import InputError
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.running.run_files import ProgramRejectedError, run_job

PICTURE = "path"


def path_picture(
    files: Mapping[str, str], robot: str | None = None, station: str | None = None
) -> bytes:
    """Run a program and draw the path of the TCP, as PNG.

    Raises:
        InputError: If the input cannot be used, the program has errors, or nothing moves.
    """
    require("matplotlib", "a picture")
    # Only pictures need it.
    from rapidsim.plots.write import write_plots  # noqa: PLC0415

    with sent_program(files, robot, station, strict=False) as program:
        try:
            simulation = run_job(job(program.request)).simulation
        except ProgramRejectedError as error:
            raise InputError(program.text(str(error)), "`check` shows all errors") from None
        with TemporaryDirectory() as folder:
            written = write_plots(simulation, folder)
            found = next((one for one in written if one.stem == PICTURE), None)
            if found is None:
                raise InputError("there is no path to draw")
            return Path(found).read_bytes()
