"""Entry procedures of the tasks of a job."""

from __future__ import annotations

from rapidsim.analysis.program import Program
from rapidsim.files import InputError, did_you_mean
from rapidsim.syntax import tree

_NAMED_PROCEDURES = 8


def require_entry(program: Program, name: str, task: str = "") -> None:
    """Check that a program has an entry procedure that can be started without arguments.

    Args:
        program: The program.
        name: The procedure.
        task: Its task, if it is one of several.

    Raises:
        InputError: If there is no such procedure, or it requires arguments.
    """
    startable = [
        routine.name
        for routine in program.routines.values()
        if isinstance(routine.node, tree.Proc) and all(p.optional for p in routine.parameters)
    ]
    if name.lower() in (one.lower() for one in startable):
        return
    if name.lower() in program.routines:
        raise InputError(f"`{name}` is not a procedure that runs without arguments")
    named = ", ".join(f"`{one}`" for one in startable[:_NAMED_PROCEDURES])
    named += ", ..." if len(startable) > _NAMED_PROCEDURES else ""
    raise InputError(
        f"{f'the task {task}' if task else 'the program'} has no procedure `{name}`",
        did_you_mean(name, startable) or (f"--proc names one: {named}" if startable else None),
    )
