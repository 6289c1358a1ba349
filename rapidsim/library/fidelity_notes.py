"""Saying which options of an instruction a run does not heed, and refusing it in UNDO clauses."""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.language.controller import Controller, FidelityReporter
from rapidsim.language.error_numbers import IN_UNDO
from rapidsim.language.errors import NotAllowed


def note_ignored_options(
    controller: FidelityReporter, routine: str, options: Mapping[str, object]
) -> None:
    r"""Report the options that were given and change nothing.

    Args:
        controller: Takes the report.
        routine: The instruction.
        options: Value by RAPID name, such as `\Corr`; None and FALSE are not given.
    """
    for name, value in options.items():
        if value is not None and value is not False:
            controller.not_simulated(f"{routine} {name}", "ignored")


def reject_in_undo(controller: Controller, routine: str) -> None:
    """Refuse what may not stand in an UNDO clause: whatever moves the robot, and Stop.

    Source: Technical reference manual RAPID Overview, "UNDO": limitations; of Stop from memory.
    """
    if controller.error_numbers.handler == IN_UNDO:
        raise NotAllowed(f"{routine} in an UNDO clause, which only tidies up")
