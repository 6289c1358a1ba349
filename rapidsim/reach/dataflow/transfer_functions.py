"""Execution of an installed instruction on known values by its Python function, without a robot."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

from rapidsim.analysis.evaluation import Evaluator, Known, NotStatic
from rapidsim.interpreter.codegen.bound_arguments import match_arguments
from rapidsim.interpreter.codegen.data_access import by_reference
from rapidsim.interpreter.codegen.written_paths import bare
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.controller import uniform_controller
from rapidsim.language.data import Signal
from rapidsim.language.errors import RapidError, Stopped
from rapidsim.language.path_events import RaiseInterrupt, Trigger
from rapidsim.language.reference import Box
from rapidsim.language.types import SIGNALS, ArrayOf, resolved
from rapidsim.library.predefined import TYPES
from rapidsim.library.table import LibraryRoutine, Parameter
from rapidsim.library.traits import Trait
from rapidsim.reach.dataflow.controller_stub import ControllerStub, NeedsRunError
from rapidsim.reach.dataflow.known_values import argument_values
from rapidsim.syntax import tree
from rapidsim.values import value_class

_TRIGGER = TYPES["triggdata"]
_EVENT_TYPES = {_TRIGGER, *SIGNALS}
_ANY_TRIGGER = Trigger(RaiseInterrupt(0.0))
_ANY_SIGNAL = Signal("any")
"""Values of all triggers and signals: what happens along the path of a move does not affect it."""
_Reference: TypeAlias = tuple[Box[Known], Known, tree.Expression | None]
"""Box that an instruction may write, its value before, and the argument that names the data."""


@value_class(frozen=True, slots=True, eq=False)
class InstructionEffect:
    """Effect of an instruction on the data passed to it by reference."""

    written: tuple[tuple[tree.DataPath, Known], ...] = ()
    continues: bool = True
    """Whether the next statement is executed; False after ExitCycle and similar instructions."""


def perform(
    routine: LibraryRoutine,
    arguments: Sequence[tree.Argument],
    evaluator: Evaluator,
    recorder: ControllerStub,
) -> InstructionEffect | str:
    """Execute an instruction; return its effect, or the reason why it requires a run.

    Args:
        routine: The instruction.
        arguments: The arguments of its call.
        evaluator: Evaluates the arguments as far as possible.
        recorder: Receives the settings and moves of the instruction.
    """
    signature = routine.signature
    if any(parameter.deferred for parameter in signature.parameters):
        return "only a run can tell"
    given = match_arguments(arguments, signature.parameters)
    # Most instructions have many options, and most calls few arguments.
    there = [one for one in signature.parameters if one.name.lower() in given]
    searches = Trait.SEARCH in routine.traits
    plain = [one for one in there if not _is_path_event(one, searches=searches)]
    values = argument_values(plain, given, evaluator)
    if isinstance(values, NotStatic):
        return values.reason
    references: list[_Reference] = []
    required: list[object] = []
    if signature.takes_controller:
        required.append(signature.concern_of(uniform_controller(recorder)))
    options: dict[str, object] = {}
    for parameter in there:
        key = parameter.name.lower()
        # In its own box: some instructions write to it.
        value = values[key] if key in values else _path_event_value(parameter)
        if key in values and by_reference(parameter.mode):
            if any(isinstance(resolved(of), ArrayOf) for of in parameter.types):
                return "an array is given by reference"
            cell = Box(value)
            references.append((cell, value, given[key].value))
            value = cell
        if parameter.by_keyword:
            options[parameter.python] = value
        else:
            required.append(value)
    for keyword, open_parameter in signature.types_of:
        typed = given.get(open_parameter.name.lower())
        if typed is None or typed.value is None:
            return "its type is not known"
        options[keyword] = evaluator.tables.type_of.get(typed.value)
    return _execute(routine, required, options, references)


def _is_path_event(parameter: Parameter, *, searches: bool) -> bool:
    """Whether a parameter affects what happens along the path of a move, not where it leads."""
    is_result = searches and parameter.mode is ParameterMode.INOUT
    return is_result or not _EVENT_TYPES.isdisjoint(parameter.types)


def _path_event_value(parameter: Parameter) -> object:
    value = _ANY_TRIGGER if _TRIGGER in parameter.types else _ANY_SIGNAL
    return Box(value) if by_reference(parameter.mode) else value


def _execute(
    routine: LibraryRoutine,
    required: Sequence[object],
    options: Mapping[str, object],
    references: Iterable[_Reference],
) -> InstructionEffect | str:
    try:
        routine.body(*required, **options)
    except NeedsRunError:
        return f"`{routine.name}` reads where the robot is"
    except Stopped:
        return InstructionEffect(continues=False)
    except RapidError as error:
        return f"it fails: {error.message}"
    return InstructionEffect(tuple(_written(references)))


def _written(references: Iterable[_Reference]) -> Iterator[tuple[tree.DataPath, Known]]:
    """Data that the call has changed, with their new values."""
    for cell, old, argument in references:
        if argument is None or cell.value is old:
            continue
        path = bare(argument)
        if isinstance(path, tree.DataReference | tree.Index | tree.ComponentAccess):
            yield path, cell.value
