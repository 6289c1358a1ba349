"""Zero orientations of persistents that are declared without an initial value.

On a controller, a persistent of another task with the same name defines the value. A task that is
checked or run without that task has zeros there, and stops at a move to them as the controller
would. It is an error of the cell only if no task defines a value.

Source: RAPID Overview, "Persistent declarations"; "Initialization of data objects".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic
from rapidsim.language.target_violations import TOLERATED_NORM_ERROR, QuaternionNotUnit
from rapidsim.reach.taint import is_set_externally


def is_valueless(finding: Diagnostic, programs: Sequence[Program]) -> bool:
    """Whether a run of one task had zeros for an orientation that another task may define."""
    violation = finding.violation
    return (
        isinstance(violation, QuaternionNotUnit)
        and violation.length < TOLERATED_NORM_ERROR
        and len(programs) == 1
        and is_set_externally(programs[0])
    )


def doubt_valueless(finding: Diagnostic, programs: Sequence[Program]) -> Diagnostic:
    """Return the finding; a zero orientation is a warning if another task may define the value."""
    violation = finding.violation
    if isinstance(violation, QuaternionNotUnit) and is_valueless(finding, programs):
        valueless = QuaternionNotUnit(
            violation.target, violation.length, violation.refused, valueless=True
        )
        return replace(finding, violation=valueless, assumed=True)
    return finding
