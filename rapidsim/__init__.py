"""RAPID interpreter and command-line simulator for ABB robots."""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False  # Importing typing would take longer than all of this.
if TYPE_CHECKING:
    from typing import Any

    from rapidsim.api.cell import Cell, load
    from rapidsim.api.run import Run
    from rapidsim.api.schemas import json_schema
    from rapidsim.files import InputError
    from rapidsim.jobs.checking.check_files import check
    from rapidsim.jobs.checking.check_result import CheckResult
    from rapidsim.jobs.running.routine_call import CallError
    from rapidsim.jobs.running.run_files import ProgramRejectedError, simulate
    from rapidsim.motion.robot.catalogue import RobotError
    from rapidsim.motion.robot.robot import load_robot
    from rapidsim.recording.layout.write import record
    from rapidsim.syntax.parser import parse

__version__ = "0.2.0"

__all__ = [
    "CallError",
    "Cell",
    "CheckResult",
    "InputError",
    "ProgramRejectedError",
    "RobotError",
    "Run",
    "__version__",
    "check",
    "json_schema",
    "load",
    "load_robot",
    "parse",
    "record",
    "simulate",
]

# Where the public names live. They are imported when first used, so that parsing or checking a
# program does not pay for NumPy or rerun.
_HOMES = {
    "CallError": "rapidsim.jobs.running.routine_call",
    "Cell": "rapidsim.api.cell",
    "CheckResult": "rapidsim.jobs.checking.check_result",
    "InputError": "rapidsim.files",
    "ProgramRejectedError": "rapidsim.jobs.running.run_files",
    "RobotError": "rapidsim.motion.robot.catalogue",
    "Run": "rapidsim.api.run",
    "json_schema": "rapidsim.api.schemas",
    "load": "rapidsim.api.cell",
    "check": "rapidsim.jobs.checking.check_files",
    "load_robot": "rapidsim.motion.robot.robot",
    "parse": "rapidsim.syntax.parser",
    "record": "rapidsim.recording.layout.write",
    "simulate": "rapidsim.jobs.running.run_files",
}
_NEEDS = {"record": "rerun"}  # Packages that not everybody has.


def __getattr__(name: str) -> Any:
    """Import a public name."""
    if name not in _HOMES:
        raise AttributeError(f"module 'rapidsim' has no attribute {name!r}")
    if name in _NEEDS:
        from rapidsim.extras import require

        require(_NEEDS[name], f"rapidsim.{name}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    """All public names, imported or not."""
    return sorted(__all__)
