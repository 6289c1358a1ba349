"""Reports of ignored options, and the rejection of instructions in UNDO clauses."""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.language.controller import Controller, FidelityReporter
from rapidsim.language.error_numbers import IN_UNDO
from rapidsim.language.errors import NotAllowed


def note_ignored_options(
    controller: FidelityReporter, routine: str, options: Mapping[str, object]
) -> None:
    r"""Report options that are present but have no effect.

    Args:
        controller: Receives the report.
        routine: The instruction.
        options: Value by RAPID name, such as `\Corr`; absent if None or False.
    """
    for name, value in options.items():
        if value is not None and value is not False:
            controller.not_simulated(f"{routine} {name}", "ignored")


def reject_in_undo(controller: Controller, routine: str) -> None:
    """Reject an instruction in an UNDO clause: moves of the robot, and Stop.

    Source: Technical reference manual RAPID Overview, "UNDO": limitations; of Stop from memory.
    """
    if controller.error_numbers.handler == IN_UNDO:
        raise NotAllowed(f"{routine} in an UNDO clause, which only tidies up")
