"""`rapidsim protocol`: questions to a controller, and its answers compared with a run here."""

from __future__ import annotations

from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import (
    current_terminal,
    echo,
    print_json,
    table_or_json,
    terminal_options,
)
from rapidsim.files import InputError
from rapidsim.jobs.inputs.robot_choice import DEFAULT_ROBOT
from rapidsim.json_records.encoding import json_of


@click.command(short_help="Ask a controller twenty questions, and compare.")
@click.argument("answers", required=False, metavar="ANSWERS")
@click.option(
    "--robot",
    metavar="NAME",
    help="The arm that answers here.  [default: that of ANSWERS]",
)
@table_or_json
@terminal_options
def protocol(answers: str | None, robot: str | None, output_format: str) -> int:
    """Ask a controller twenty open questions, and compare the answers.

    Without ANSWERS it writes Questions.mod into this folder: a program with twenty questions, to be
    run on a controller, real or virtual. ANSWERS is the file that it writes there. --format json
    prints what to send: RobotWare, arm, operating mode, speed and answers, and nothing else.
    """
    from rapidsim.applications.protocol.protocol import (
        MODULE,
        arm_of,
        questions,
        read_protocol,
        run_protocol,
    )
    from rapidsim.applications.protocol.protocol_table import protocol_table

    if answers is None:
        if output_format == "json":
            raise InputError("--format json needs the answers", "name their file")
        target = Path(MODULE)
        if target.exists():
            raise InputError(f"{MODULE} is here already", "it is never overwritten")
        target.write_text(questions(), encoding="utf-8", newline="\r\n")
        echo(f"Written: {MODULE}. Run it on a controller, then `rapidsim protocol ANSWERS`.")
        return ExitCode.CLEAN
    theirs = read_protocol(Path(answers))
    if output_format == "json":
        print_json(json_of(theirs))
    else:
        arm = robot or arm_of(theirs) or DEFAULT_ROBOT
        current_terminal().show(protocol_table(theirs, run_protocol(arm), arm))
    return ExitCode.CLEAN
