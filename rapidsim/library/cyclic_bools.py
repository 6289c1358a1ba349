r"""Cyclic bools: persistents that the controller keeps equal to a condition.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "SetupCyclicBool",
"RemoveCyclicBool", "IsCyclicBool", "GetNextCyclicBool".
"""

from __future__ import annotations

from rapidsim.language.annotations import (
    Bool,
    Deferred,
    Num,
    Pers,
    SignalDo,
    String,
    Switch,
    TaskId,
    Var,
)
from rapidsim.language.controller import Controller
from rapidsim.language.cyclic_bools import CyclicBools
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.signals import connected
from rapidsim.library.table import routine, table

MOST = 100
"""Maximum number of cyclic bools."""


def setup_cyclic_bool(
    controller: Controller,
    flag: Pers[Bool],
    cond: Deferred[Bool],
    *,
    signal: Var[SignalDo] | None = None,
) -> None:
    """Keep a persistent, and optionally an output, equal to a condition."""
    kept = controller.cyclic_bools
    name = _name(controller, flag)
    if len(kept.names()) >= MOST and name not in kept.names():
        raise rapid_error(ERR_ARGVALERR, f"{MOST} cyclic bools are set up already")
    kept.set_up(name, flag, cond, None if signal is None else connected(signal))


def remove_cyclic_bool(controller: Controller, flag: Bool | String) -> None:
    """Stop updating a persistent, passed as the data or by its name."""
    controller.cyclic_bools.remove(_name(controller, flag))


def remove_all_cyclic_bool(controller: Controller, *, all_tasks: Switch = False) -> None:
    """Stop updating all persistents."""
    note_ignored_options(controller.fidelity, "RemoveAllCyclicBool", {r"\AllTasks": all_tasks})
    for name in controller.cyclic_bools.names():
        controller.cyclic_bools.remove(name)


def is_cyclic_bool(
    controller: Controller,
    flag: Bool | String,
    *,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
) -> Bool:
    """Whether a persistent, passed as the data or by its name, is kept equal to a condition."""
    note_ignored_options(
        controller.fidelity, "IsCyclicBool", {r"\TaskRef": task_ref, r"\TaskName": task_name}
    )
    kept = [name.lower() for name in controller.cyclic_bools.names()]
    return _name(controller, flag).lower() in kept


def get_number_of_cyclic_bool(controller: CyclicBools) -> Num:
    """The number of cyclic bools that are set up."""
    return float(len(controller.names()))


def get_max_number_of_cyclic_bool() -> Num:
    """The maximum number of cyclic bools."""
    return float(MOST)


def get_next_cyclic_bool(controller: CyclicBools, list_number: Var[Num], name: Var[String]) -> Bool:
    """The name of the next cyclic bool, by list number from 0; FALSE after the last."""
    names, number = controller.names(), int(list_number.value)
    if not 0 <= number < len(names):
        return False
    list_number.value, name.value = float(number + 1), names[number]
    return True


def _name(controller: Controller, flag: object) -> str:
    """Name of a persistent in the program, or the name passed as a string."""
    if isinstance(flag, str):
        return flag
    return controller.clock.place.arguments.get("flag", "")


CYCLIC_BOOLS = table(
    routine("SetupCyclicBool", setup_cyclic_bool, r"Flag Cond \Signal"),
    routine("RemoveCyclicBool", remove_cyclic_bool),
    routine("RemoveAllCyclicBool", remove_all_cyclic_bool),
    routine("IsCyclicBool", is_cyclic_bool, r"Flag \TaskRef|\TaskName"),
    routine("GetNumberOfCyclicBool", get_number_of_cyclic_bool),
    routine("GetMaxNumberOfCyclicBool", get_max_number_of_cyclic_bool),
    routine("GetNextCyclicBool", get_next_cyclic_bool),
)
