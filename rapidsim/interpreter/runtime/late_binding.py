"""Calls of a procedure whose name is only known at run time: `%"job" + n% args;`.

The search begins in the module of the call: its own procedures, then the global ones of the
task, then installed instructions. `"Module:proc"` looks in one module, `":proc"` in the task.

Source: Technical reference manual RAPID Overview, "Procedure calls with late binding".
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from typing import Any, NoReturn

from rapidsim.analysis.literals import is_signal
from rapidsim.analysis.program import ParameterSymbol, RoutineSymbol
from rapidsim.interpreter.runtime.arrays import copy_array
from rapidsim.interpreter.runtime.references import ABSENT
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.controller import Controller
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_CALLPROC,
    ERR_REFUNKDAT,
    ERR_REFUNKFUN,
    ERR_REFUNKPRC,
    ERR_REFUNKTRP,
    rapid_error,
)
from rapidsim.language.errors import NotDeclared, RapidError
from rapidsim.language.moves import Place
from rapidsim.language.reference import Box
from rapidsim.language.types import ANYTYPE, ArrayOf, Type, resolved
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.table import LibraryRoutine, Parameter
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class DeferredArgument:
    """An argument before the parameter that it belongs to is known."""

    key: str | None
    """Folded parameter name; None for a positional argument."""
    is_reference: bool
    """Whether the argument is passed as an object with a `value`."""
    type: Type | None
    """Type of the argument; None for a switch."""


@value_class(frozen=True, slots=True)
class UserRoutine:
    """A user routine that late binding can find."""

    symbol: RoutineSymbol
    function: Callable[..., object]


@value_class(slots=True)
class LateBinding:
    """Finds and calls procedures by name for one task."""

    controller: Controller
    global_routines: Mapping[str, UserRoutine] = field(default_factory=dict)
    """Global procedures by folded name."""
    module_routines: Mapping[str, Mapping[str, UserRoutine]] = field(default_factory=dict)
    """All procedures of each module; both names folded."""
    waiting: Mapping[str, str] = field(default_factory=dict)
    """Reason why routines of loaded modules cannot be called yet, by folded name."""

    def call(
        self,
        module: str,
        place: Place,
        name: str,
        shapes: Sequence[DeferredArgument],
        values: Sequence[object],
    ) -> None:
        """Call a procedure from a position in a module, the latter by its folded name.

        Raises:
            RapidError: ERR_REFUNKPRC if nothing has the name, ERR_CALLPROC if it is not a
                procedure or takes other arguments.
        """
        found = self._find(name, module)
        if isinstance(found, UserRoutine):
            _called(found, name, shapes, values)
        else:
            self._call_installed(found, place, name, shapes, values)

    def declares(self, module: str, name: str) -> bool:
        """Whether a loaded module, even one still waiting to be linked, declares a routine."""
        return name.lower() in self.waiting or self._find_user(module, "", False, name) is not None

    def value(
        self,
        module: str,
        name: str,
        shapes: Sequence[DeferredArgument],
        values: Sequence[object],
        of: Type,
    ) -> object:
        """Return the value of a function that was declared after its call was translated.

        Raises:
            RapidError: ERR_REFUNKFUN if nothing has the name, or it is not a function of the type
                required here.
        """
        found = self._find_user(module, "", False, name)
        if found is None:
            raise self._waits(name)
        if found.symbol.result is None or not _fits(found.symbol.result, of):
            raise rapid_error(ERR_REFUNKFUN, f'"{name}" is not a function of type {of.name}')
        return _called(found, name, shapes, values)

    def trap(self, module: str, name: str) -> UserRoutine:
        """Return a trap routine for CONNECT.

        Raises:
            RapidError: ERR_REFUNKTRP when no trap routine has the name.
        """
        prefix, colon, key = name.strip().lower().rpartition(":")
        found = self._find_user(module, prefix, bool(colon), key)
        if found is None or not isinstance(found.symbol.node, tree.Trap):
            raise rapid_error(ERR_REFUNKTRP, f'no trap routine is named "{name}"')
        return found

    def _find_user(self, module: str, prefix: str, colon: bool, name: str) -> UserRoutine | None:
        key = name.lower()
        if prefix:
            return self.module_routines.get(prefix, {}).get(key)
        found = None if colon else self.module_routines.get(module, {}).get(key)
        return found or self.global_routines.get(key)

    def _waits(self, name: str) -> RapidError:
        """Error for a routine of a loaded module that cannot be called yet."""
        return rapid_error(
            ERR_REFUNKDAT, f'"{name}" cannot be called: {self.waiting[name.lower()]}'
        )

    def _find(self, name: str, module: str) -> UserRoutine | LibraryRoutine:
        prefix, colon, key = name.strip().lower().rpartition(":")
        found = self._find_user(module, prefix, bool(colon), key)
        if found is not None:
            if isinstance(found.symbol.node, tree.Proc):
                return found
            raise rapid_error(ERR_CALLPROC, f'"{name}" is not a procedure')
        if key in self.waiting:
            raise self._waits(key)
        installed = ROUTINES.get(key) if not prefix else None
        if installed is None:
            raise rapid_error(ERR_REFUNKPRC, f'no procedure is named "{name}"')
        if installed.signature.result is not None:
            raise rapid_error(ERR_CALLPROC, f'"{name}" is not a procedure')
        if Trait.CALL_BY_NAME in installed.traits:  # Such a call is translated in place.
            raise rapid_error(ERR_CALLPROC, f"{installed.name} by late binding is not simulated")
        return installed

    def _call_installed(
        self,
        routine: LibraryRoutine,
        place: Place,
        name: str,
        shapes: Sequence[DeferredArgument],
        values: Sequence[object],
    ) -> None:
        signature = routine.signature
        given = _bound(name, signature.parameters, shapes, values)
        positional: list[object] = []
        if signature.takes_controller:
            positional.append(signature.concern_of(self.controller))
        options: dict[str, Any] = {}
        for parameter in signature.parameters:
            if parameter.name.lower() not in given:
                continue
            if parameter.deferred:
                raise rapid_error(ERR_CALLPROC, f"{routine.name} by late binding is not simulated")
            shape, value = given[parameter.name.lower()]
            wants_signal = any(is_signal(of) for of in parameter.types)
            if parameter.mode is ParameterMode.IN and shape.is_reference and not wants_signal:
                value = value.value if value is not ABSENT else None
            elif parameter.mode is not ParameterMode.IN:
                value = _lent(shape, value)
            if parameter.by_keyword:
                options[parameter.python] = None if value is ABSENT else value
            else:
                positional.append(value)
        for keyword, parameter in signature.types_of:
            one = given.get(parameter.name.lower())
            options[keyword] = one[0].type if one else None
        if signature.takes_controller:
            self.controller.clock.place = place
        routine.body(*positional, **options)


def numbered_name(name: str, number: float) -> str:
    """Name of the procedure that CallByVar calls; only global ones of the task are searched.

    Raises:
        RapidError: ERR_ARGVALERR when the number is negative or not whole.
    """
    if number < 0 or number != int(number):
        raise rapid_error(ERR_ARGVALERR, f"CallByVar takes whole numbers from 0 on, not {number:G}")
    return f":{name}{int(number)}"


def _called(
    routine: UserRoutine, name: str, shapes: Sequence[DeferredArgument], values: Sequence[object]
) -> object:
    parameters = routine.symbol.parameters
    given = _bound(name, parameters, shapes, values)
    return routine.function(*(_user_value(p, given.get(p.name.lower())) for p in parameters))


def key_of(name: str, parameters: Sequence[ParameterSymbol | Parameter]) -> str:
    """Folded name of the parameter that a named argument refers to."""
    for parameter in parameters:
        if isinstance(parameter, Parameter) and parameter.also.lower() == name:
            return parameter.name.lower()
    return name


def _bound(
    name: str,
    parameters: Sequence[ParameterSymbol] | Sequence[Parameter],
    shapes: Sequence[DeferredArgument],
    values: Sequence[object],
) -> dict[str, tuple[DeferredArgument, Any]]:
    """Match arguments to parameters by folded name; raise if they do not fit."""
    by_key = {parameter.name.lower(): parameter for parameter in parameters}
    required = [parameter.name.lower() for parameter in parameters if not parameter.optional]
    waiting = iter(required)
    given: dict[str, tuple[DeferredArgument, Any]] = {}
    for shape, value in zip(shapes, values, strict=True):
        key = next(waiting, None) if shape.key is None else key_of(shape.key, parameters)
        parameter = by_key.get(key) if key is not None else None
        if key is None or parameter is None:
            raise _mismatch(name, "it takes fewer arguments")
        types, words = _accepted_types(parameter)
        if shape.type is not None and not any(_fits(shape.type, of) for of in types):
            raise _mismatch(name, f"{parameter.name} takes {words}, not {shape.type.name}")
        given[key] = (shape, value)
    missing = [key for key in required if key not in given]
    if missing:
        raise _mismatch(name, f"{missing[0]} is missing")
    return given


def _accepted_types(parameter: ParameterSymbol | Parameter) -> tuple[tuple[Type, ...], str]:
    """Types that a parameter accepts, and their description for messages."""
    if not isinstance(parameter, Parameter):
        return (parameter.type,), parameter.type.name
    if parameter.only is not None:
        return parameter.only.types, parameter.only.words
    return parameter.types, parameter.types[0].name


def _fits(actual: Type, wanted: Type) -> bool:
    actual, wanted = resolved(actual), resolved(wanted)
    if isinstance(actual, ArrayOf) and isinstance(wanted, ArrayOf):
        same_element = _fits(actual.element, wanted.element)
        return same_element and len(actual.dimensions) == len(wanted.dimensions)
    return wanted == ANYTYPE or actual.name.lower() == wanted.name.lower()


def _user_value(
    parameter: ParameterSymbol, argument: tuple[DeferredArgument, Any] | None
) -> object:
    if argument is None:
        return False if parameter.is_switch else ABSENT
    shape, value = argument
    if is_signal(parameter.type):
        return value
    if parameter.mode is not ParameterMode.IN:
        return _lent(shape, value)
    if shape.is_reference and value is not ABSENT:
        return value.value
    return copy_array(value) if isinstance(value, list) else value


def _lent(shape: DeferredArgument, value: Any) -> Any:
    """An argument for a parameter that takes a reference."""
    is_one = shape.is_reference or isinstance(value, list) or value is ABSENT
    return value if is_one else Box(value)


def _mismatch(name: str, reason: str) -> RapidError:
    return rapid_error(ERR_CALLPROC, f'"{name}" cannot be called like this: {reason}')


def unresolved_procedure(name: str) -> NoReturn:
    """Raise the error for a call of an undeclared procedure, in a task that allows such calls.

    Raises:
        RapidError: ERR_REFUNKPRC.
    """
    raise rapid_error(ERR_REFUNKPRC, f"no procedure is named `{name}`")


def unresolved_function(name: str) -> NoReturn:
    """Raise the error for a call of an undeclared function, in a task that allows such calls.

    Raises:
        RapidError: ERR_REFUNKFUN.
    """
    raise rapid_error(ERR_REFUNKFUN, f"no function is named `{name}`")


def unresolved_data(name: str, reason: str | None) -> NoReturn:
    """Stop at the use of undeclared data.

    Raises:
        RapidError: ERR_REFUNKDAT in a task that allows undeclared names.
        NotDeclared: In another task, whose controller declares them; `reason` is the missing part.
    """
    if reason is not None:
        raise NotDeclared(reason)
    raise rapid_error(ERR_REFUNKDAT, f"no data are named `{name}`")
