"""Saying which options of an instruction a run does not heed."""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.language.controller import Honesty


def ignored(controller: Honesty, routine: str, options: Mapping[str, object]) -> None:
    r"""Report the options that were given and change nothing.

    Args:
        controller: Takes the report.
        routine: The instruction.
        options: Value by RAPID name, such as `\Corr`; None and FALSE are not given.
    """
    for name, value in options.items():
        if value is not None and value is not False:
            controller.not_simulated(f"{routine} {name}", "ignored")
