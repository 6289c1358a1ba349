"""Names in the namespace of generated code in addition to the program's own names.

All these names begin with an underscore, which no RAPID name does. `FUNCTIONS` are the same for
every task; `task_functions` call one task's controller.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Any, NoReturn

from rapidsim.interpreter.linking.argument_names import argument_name
from rapidsim.interpreter.runtime import arrays, error_recovery, references
from rapidsim.interpreter.runtime.error_recovery import Recovery
from rapidsim.interpreter.runtime.late_binding import (
    DeferredArgument,
    LateBinding,
    numbered_name,
    unresolved_data,
    unresolved_function,
    unresolved_procedure,
)
from rapidsim.interpreter.runtime.memory import is_persistent
from rapidsim.language.controller import CONCERNS, STUB, Controller
from rapidsim.language.error_numbers import ERR_ALRDYCNT, ERR_ARGDUPCND, ERR_EXECPHR, rapid_error
from rapidsim.language.errors import ProgramReset, RapidError
from rapidsim.language.moves import Place
from rapidsim.language.reference import Box, Reference
from rapidsim.language.types import Type
from rapidsim.library import arithmetic


def unfinished() -> NoReturn:
    """Raise for the execution of a placeholder."""
    raise rapid_error(ERR_EXECPHR, "the program is unfinished here: a placeholder was reached")


def at_most_one(value: object, *is_there: bool) -> object:
    """Return the last of several options that exclude each other.

    Raises:
        RapidError: ERR_ARGDUPCND if more than one is present.
    """
    if sum(is_there) > 1:
        raise rapid_error(ERR_ARGDUPCND, "two optional arguments that exclude each other are given")
    return value


FUNCTIONS: Mapping[str, object] = MappingProxyType(
    {
        "_ABSENT": references.ABSENT,
        "_BaseException": BaseException,
        "_Box": Box,
        "_Component": references.ComponentReference,
        "_ERRORS": error_recovery.ERRORS,
        "_Element": references.Element,
        "_FellThrough": error_recovery.FellThrough,
        "_Leave": error_recovery.HandlerReturn,
        "_ProgramReset": ProgramReset,
        "_add_positions": arithmetic.add_positions,
        "_assign_array": arrays.assign_array,
        "_at_most_one": at_most_one,
        "_checked_integer": arithmetic.checked_integer,
        "_compose_orientations": arithmetic.compose_orientations,
        "_copy_array": arrays.copy_array,
        "_count": arithmetic.count,
        "_cross_product": arithmetic.cross_product,
        "_dimension": arrays.dimension,
        "_divide_position": arithmetic.divide_position,
        "_double_integer": arithmetic.double_integer,
        "_index_table_of": arrays.index_table_of,
        "_index_tables": arrays.INDEX_TABLES,
        "_int": int,
        "_is_persistent": is_persistent,
        "_len": len,
        "_literal_quotient": arithmetic.literal_quotient,
        "_magnitude": abs,
        "_negate_position": arithmetic.negate_position,
        "_new": tuple.__new__,
        "_numbered_name": numbered_name,
        "_no_return": error_recovery.no_return,
        "_not_present": references.not_present,
        "_out_of_bounds": arrays.out_of_bounds,
        "_overflow": arithmetic.overflow,
        "_quotient": arithmetic.integer_quotient,
        "_raised": error_recovery.raised,
        "_range": range,
        "_remainder": arithmetic.integer_remainder,
        "_root": math.sqrt,
        "_scale_position": arithmetic.scale_position,
        "_scaled_position": arithmetic.scaled_position,
        "_single_integer": arithmetic.single_integer,
        "_steps": arithmetic.steps,
        "_subtract_positions": arithmetic.subtract_positions,
        "_too_long": arithmetic.too_long,
        "_turns_of": arithmetic.turns_of,
        "_turns_taken": arithmetic.iteration_count,
        "_unfinished": unfinished,
        "_unresolved_data": unresolved_data,
        "_unresolved_function": unresolved_function,
        "_unresolved_procedure": unresolved_procedure,
        "_whole_quotient": arithmetic.whole_quotient,
        "_whole_remainder": arithmetic.whole_remainder,
    }
)
"""Functions by their names in generated code."""


def task_functions(
    controller: Controller, recovery_of_task: Recovery, late: LateBinding, module: str
) -> dict[str, object]:
    """Functions with which the code of one module, by folded name, calls its task's controller."""
    clock, interrupts = controller.clock, controller.interrupts

    def call_at(
        place: Place, body: Callable[..., Any], query: object, *values: object, **options: object
    ) -> Any:
        clock.place = place
        return body(query, *values, **options)

    def look_at(
        place: Place, body: Callable[..., Any], query: object, *values: object, **options: object
    ) -> Any:
        before, clock.place = clock.place, place
        value = body(query, *values, **options)
        clock.place = before
        return value

    def set_at(
        place: Place, body: Callable[..., Any], query: object, *values: object, **options: object
    ) -> None:
        before, clock.place = clock.place, place
        deeds = clock.effect_count
        body(query, *values, **options)
        if clock.effect_count == deeds:
            # The output had this value already: to a loop this is only a read.
            clock.place = before

    def stand_in(place: Place, name: str, replacement: str, value: object) -> object:
        before, clock.place = clock.place, place
        controller.fidelity.not_simulated(name, replacement, is_unknown=replacement != STUB)
        clock.note_unknown()
        clock.place = before
        return value

    def skip(place: Place, name: str) -> None:
        stand_in(place, name, "skipped", None)

    def loaded(
        place: Place, name: str, shapes: Sequence[DeferredArgument], values: Sequence[object]
    ) -> None:
        if late.declares(module, name):
            late.call(module, place, name, shapes, values)
        else:
            skip(place, name)

    def loaded_function(
        place: Place,
        name: str,
        shapes: Sequence[DeferredArgument],
        values: Sequence[object],
        of: Type,
        default: Callable[[], object],
    ) -> object:
        if late.declares(module, name):
            return late.value(module, name, shapes, values, of)
        return default()

    def name_of_argument(
        place: Place, parameter: str, number: Reference[float] | None = None
    ) -> str:
        try:
            name = argument_name(sys._getframe(1), parameter.lower())
        except RapidError as error:
            if number is None:
                raise
            number.value = error.errno
            return ""
        if name is None:
            instead = "the parameter's own name where a statement has calls on later lines"
            stand_in(place, "ArgName", instead, None)
        return name or parameter

    def served(left: int) -> int:
        clock.ticks_left = left
        clock.service()
        return clock.ticks_left

    def connect(number: float, trap: Callable[[], object], name: str) -> float:
        if interrupts.is_connected(number):
            raise rapid_error(
                ERR_ALRDYCNT,
                "the interrupt is connected to a trap routine already; IDelete it first",
            )
        return interrupts.connect(recovery_of_task.trap(trap), name)

    def connect_late(number: float, name: str) -> float:
        found = late.trap(module, name)
        return connect(number, found.function, found.symbol.name)

    return {
        "_argument_name": name_of_argument,
        "_call_at": call_at,
        "_connect": connect,
        "_connect_late": connect_late,
        "_late": partial(late.call, module),
        "_leave_routine": recovery_of_task.leave,
        "_loaded": loaded,
        "_look_at": look_at,
        "_loaded_function": loaded_function,
        "_propagate": recovery_of_task.propagate,
        "_recover": recovery_of_task.recover,
        "_served": served,
        "_set_at": set_at,
        "_skip": skip,
        "_stand_in": stand_in,
        "_controller": controller,
        **{f"_{concern}": getattr(controller, concern) for concern in CONCERNS.values()},
    }
