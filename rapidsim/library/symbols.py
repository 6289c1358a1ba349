r"""Data by name: reading, writing and searching.

Only data that modules of the task declare are found; routine data, parameters and predefined data
are not. Patterns are regular expressions and must match the whole name, in any case.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "GetDataVal",
"SetDataSearch", "GetNextSym" and their like.
"""

from __future__ import annotations

from rapidsim.language.annotations import (
    AnyType,
    ArgumentType,
    Bool,
    DataPos,
    InOut,
    String,
    Switch,
    TaskId,
    Var,
)
from rapidsim.language.controller import Controller
from rapidsim.language.reference import Reference
from rapidsim.language.symbols import DataName, DataSearch
from rapidsim.language.types import NUM
from rapidsim.library.table import routine, table
from rapidsim.library.task_arguments import means_another
from rapidsim.library.traits import Trait


def get_data_val(
    controller: Controller,
    object_: String,
    value: Var[AnyType],
    *,
    block: Var[DataPos] | None = None,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Read data whose name is a string."""
    _own_task_only(controller, "GetDataVal", task_ref, task_name)
    read = controller.symbols.read(object_, of, _block_of(block))
    if isinstance(value, list):
        assert isinstance(read, list)
        value[:] = read
    else:
        value.value = read


def set_data_val(
    controller: Controller,
    object_: String,
    value: Var[AnyType],
    *,
    block: Var[DataPos] | None = None,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Write data whose name is a string."""
    _own_task_only(controller, "SetDataVal", task_ref, task_name)
    controller.symbols.write(object_, of, _block_of(block), _value_of(value))


def set_all_data_val(
    controller: Controller,
    type_: String,
    value: Var[AnyType],
    *,
    type_mod: String | None = None,
    object_: String | None = None,
    hidden: Switch = False,
    of: ArgumentType = NUM,
) -> None:
    """Write all variables and persistents of a type whose names match a pattern."""
    del type_mod, hidden
    search = DataSearch(type_, object_, storages=("VAR", "PERS"))
    for found in controller.symbols.search(search):
        controller.symbols.write(found.name, of, found, _value_of(value))


def set_data_search(
    controller: Controller,
    type_: String,
    *,
    type_mod: String | None = None,
    object_: String | None = None,
    pers_sym: Switch = False,
    var_sym: Switch = False,
    const_sym: Switch = False,
    in_task: Switch = False,
    in_mod: String | None = None,
    in_rout: String | None = None,
    global_sym: Switch = False,
    local_sym: Switch = False,
) -> None:
    r"""Set which data GetNextSym finds. Data of routines (\InRout) are never found."""
    del type_mod, in_task
    kinds = {"PERS": pers_sym, "VAR": var_sym, "CONST": const_sym}
    if in_rout is not None:
        controller.fidelity.not_simulated(
            r"SetDataSearch \InRout", "data of routines are not found"
        )
    search = DataSearch(
        type_,
        object_,
        storages=tuple(kind for kind, wanted in kinds.items() if wanted) or tuple(kinds),
        module=in_mod,
        only_global=global_sym,
        only_local=local_sym,
    )
    controller.symbols.begin_search(search if in_rout is None else None)


def get_next_sym(
    controller: Controller,
    object_: InOut[String],
    block: Var[DataPos],
    *,
    recursive: Switch = False,
) -> Bool:
    """The next name that matches SetDataSearch, and its position; FALSE if none remains."""
    del recursive
    found = controller.symbols.next_match()
    if found is None:
        return False
    object_.value, block.value = found.name, found
    return True


def _value_of(value: Reference[object] | list[object]) -> object:
    return value if isinstance(value, list) else value.value


def _block_of(block: Reference[DataName | None] | None) -> DataName | None:
    return None if block is None else block.value


def _own_task_only(
    controller: Controller, name: str, task_ref: Reference[object] | None, task_name: str | None
) -> None:
    if means_another(controller.tasks, task_ref, task_name):
        option = r"\TaskRef" if task_name is None else r"\TaskName"
        controller.fidelity.not_simulated(f"{name} {option}", "the data of the task itself")


_PLACE = r"\Block|\TaskRef|\TaskName"

SYMBOLS = table(
    routine("GetDataVal", get_data_val, f"Object {_PLACE} Value", does=Trait.READ_BY_NAME),
    routine("SetDataVal", set_data_val, f"Object {_PLACE} Value", does=Trait.WRITE_BY_NAME),
    routine(
        "SetAllDataVal",
        set_all_data_val,
        r"Type \TypeMod \Object \Hidden Value",
        does=Trait.WRITE_BY_NAME,
    ),
    routine(
        "SetDataSearch",
        set_data_search,
        r"Type \TypeMod \Object \PersSym \VarSym \ConstSym \InTask|\InMod \InRout "
        r"\GlobalSym|\LocalSym",
        does=Trait.READ_BY_NAME,
    ),
    routine("GetNextSym", get_next_sym, r"Object Block \Recursive", does=Trait.READ_BY_NAME),
)
