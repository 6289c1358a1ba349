r"""The table of installed routines: one row a routine, read by checker, interpreter and docs.

A row names a typed Python function; its annotations are the RAPID signature (see
`language.annotations`). What Python cannot say, that options stand before required arguments or
exclude each other, a row says in `order`, in RAPID's own spelling: `\SDelay|\Sync Signal Value`.
Of the options that a group of them stands for (`**options`), a row has those that its order names.
Reading annotations costs time, so a signature is read when first asked.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from types import MappingProxyType, NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from rapidsim.language import types
from rapidsim.language.annotations import Marker, Only, ParameterMode
from rapidsim.language.controller import CONCERNS, Controller
from rapidsim.language.records import record_of
from rapidsim.language.reference import Reference
from rapidsim.language.types import Type
from rapidsim.library.precision import in_single
from rapidsim.library.traits import LIMITS, NO_TRAITS, Trait, derived
from rapidsim.values import value_class

_SPELLINGS = {
    "id": "ID",
    "tload": "TLoad",
    "wobj": "WObj",
    "no_eoffs": "NoEOffs",
    "io_device": "IODevice",
}
"""RAPID names that are not their Python name with capitals."""
WHOLE = "controller"
"""Stands for all concerns of the controller."""


@value_class(frozen=True, slots=True)
class Parameter:
    """One parameter of an installed routine."""

    name: str
    """As RAPID spells it: `MaxTime`."""
    python: str
    """As the Python function spells it: `max_time`."""
    types: tuple[Type, ...]
    """The types it takes; several where RAPID has alternatives such as `Name | Dname`."""
    mode: ParameterMode = ParameterMode.IN
    optional: bool = False
    by_keyword: bool = False
    """The Python function takes it by keyword, as it does all that is optional."""
    is_switch: bool = False
    group: int = 0
    """Optional parameters with the same number above 0 exclude each other."""
    deferred: bool = False
    """The Python function wants a function that evaluates the argument."""
    only: Only | None = None
    """What it takes, where its type is anytype and that is too much."""
    also: str = ""
    """The other name of a required argument that may have one of two types: `Dvalue`."""


@value_class(frozen=True, slots=True)
class Signature:
    """Parameters in call order; `result` is None for an instruction.

    The Python function is given arguments by position, in this order, but those `by_keyword`.
    """

    parameters: tuple[Parameter, ...]
    result: Type | None
    concern: str = ""
    """What the Python function wants first: a concern of the controller by its name, `controller`
    for all of it; empty for nothing."""
    types_of: tuple[tuple[str, Parameter], ...] = ()
    """The Python function wants the types of these parameters' arguments, by these keywords."""
    is_open: bool = False
    """Nobody knows its parameters: it is given none, whatever the call holds."""

    @property
    def takes_controller(self) -> bool:
        """Whether the Python function wants the controller, or a concern of it, first."""
        return bool(self.concern)

    def concern_of(self, controller: Controller) -> object:
        """What of a task's controller the Python function wants first."""
        return controller if self.concern == WHOLE else getattr(controller, self.concern)


@value_class(frozen=True, eq=False)
class LibraryRoutine:
    """A row of the table."""

    name: str
    function: Callable[..., Any]
    """As it is written; `body` is what is called."""
    order: str = ""
    """The parameters as RAPID orders and spells them, options with a backslash, alternatives with
    a bar; needed only where options come first, exclude each other, or names are unusual or two."""
    treated_as: str | None = None
    """What is done instead where the routine is not simulated; None where it is."""
    stated: Trait = NO_TRAITS
    """What the row says that it does; `traits` is all."""
    sets: tuple[str, ...] = ()
    """The fields of `MotionSettings` that it sets."""
    takes_anything: bool = False
    """Whether arguments that no source gives may stand in a call; the function gets none."""
    back: str = ""
    """The call that puts a mode back to what it is at the start, if it changes one that it may
    leave behind: the switch or the percentages in it count, else the routine of that name."""

    @property
    def simulated(self) -> bool:
        """Whether the routine does what the controller's does."""
        return self.treated_as is None

    @cached_property
    def signature(self) -> Signature:
        """The RAPID signature, read from the function's annotations."""
        signature = _read_signature(self.function, self.order)
        return replace(signature, is_open=True) if self.takes_anything else signature

    @cached_property
    def traits(self) -> Trait:
        """What a call of it does."""
        names = frozenset(p.name.lower() for p in self.signature.parameters)
        return derived(self.stated, names)

    @property
    def limit(self) -> str | None:
        """The option that limits how long it waits, as RAPID spells it; None without one."""
        found = (p.name for p in self.signature.parameters if p.optional)
        return next((name for name in found if name.lower() in LIMITS), None)

    @cached_property
    def body(self) -> Callable[..., Any]:
        """The Python function, with results that have passed single precision."""
        signature = self.signature
        required = [_written(p) for p in signature.parameters if not p.by_keyword]
        if signature.takes_controller:
            required.insert(0, None)
        options = {p.python: _written(p) for p in signature.parameters if p.by_keyword}
        return in_single(self.function, signature.result, required, options)


def routine(
    name: str,
    body: Callable[..., Any],
    order: str = "",
    *,
    treated_as: str | None = None,
    does: Trait = NO_TRAITS,
    sets: tuple[str, ...] = (),
    back: str = "",
    takes_anything: bool = False,
) -> LibraryRoutine:
    """One row of a table; what its parameters say that it does need not be stated."""
    return LibraryRoutine(name, body, order, treated_as, does, sets, takes_anything, back)


def table(*rows: LibraryRoutine) -> Mapping[str, LibraryRoutine]:
    """A read-only table by folded name."""
    by_name = {row.name.lower(): row for row in rows}
    assert len(by_name) == len(rows), "a routine stands twice in its table"
    return MappingProxyType(by_name)


def _read_signature(body: Callable[..., Any], order: str) -> Signature:
    hints = get_type_hints(body, include_extras=True)
    python_parameters = list(inspect.signature(body).parameters.values())
    concern = _concern(hints[python_parameters[0].name]) if python_parameters else ""
    read: dict[str, Parameter] = {}
    grouped: set[str] = set()
    keywords: list[str] = []
    for python in python_parameters[bool(concern) :]:
        hint = hints[python.name]
        if get_origin(hint) is Annotated and Marker.ARGUMENT_TYPE in get_args(hint)[1:]:
            keywords.append(python.name)
            continue
        if python.kind is inspect.Parameter.VAR_KEYWORD:
            (group,) = get_args(hint)
            for name, member in get_type_hints(group, include_extras=True).items():
                read[_folded(name)] = _read_parameter(name, member, by_keyword=True)
                grouped.add(_folded(name))
            continue
        by_keyword = python.kind is inspect.Parameter.KEYWORD_ONLY
        read[_folded(python.name)] = _read_parameter(python.name, hint, by_keyword)
    parameters = _ordered(read, order) if order else tuple(read.values())
    missing = set(read) - {_folded(parameter.name) for parameter in parameters} - grouped
    assert not missing, f"{', '.join(missing)}: missing in the order {order!r}"
    result = hints["return"]
    return Signature(
        parameters,
        None if result is NoneType else _read_type(result)[0],
        concern,
        tuple(zip(keywords, filter(_is_open, parameters), strict=False)),
    )


def _written(parameter: Parameter) -> Type | None:
    """The type of the data that a routine may write through a parameter; None where it has none.

    Nor where it may be one of several, or is an array, whose elements are written one by one.
    """
    writes = parameter.mode in (ParameterMode.INOUT, ParameterMode.VAR) and not _is_open(parameter)
    of = parameter.types[0]
    return of if writes and not isinstance(types.resolved(of), types.ArrayOf) else None


def _ordered(read: dict[str, Parameter], order: str) -> tuple[Parameter, ...]:
    """The parameters in RAPID's order and spelling, alternatives grouped."""
    parameters = []
    group = 0
    for item in re.sub(r"\s*\|\s*", "|", order).split():
        names = item.replace("\\", "").split("|")
        optional, also = item.startswith("\\"), ""
        if not optional:
            names, also = names[:1], "".join(names[1:])
        group += len(names) > 1
        for name in names:
            found = read[_folded(name)]
            assert found.by_keyword or not optional, f"{name}: optional or not?"
            shared = group if len(names) > 1 else 0
            parameters.append(replace(found, name=name, optional=optional, group=shared, also=also))
    return tuple(parameters)


def _read_parameter(python: str, hint: object, by_keyword: bool) -> Parameter:
    members = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    read = [_read_type(member) for member in members if member is not NoneType]
    _, mode, deferred = read[0]
    found = tuple(member[0] for member in read)
    spelling = _SPELLINGS.get(python) or "".join(
        word[:1].upper() + word[1:] for word in python.split("_")
    )
    is_switch = found == (types.SWITCH,)
    only = next((one for one in _metadata(hint) if isinstance(one, Only)), None)
    return Parameter(
        spelling,
        python,
        found,
        mode,
        by_keyword,
        by_keyword,
        is_switch,
        deferred=deferred,
        only=only,
    )


def _metadata(hint: object) -> Iterator[object]:
    """What stands beside the type in an annotation, inside of references and options too."""
    yield from getattr(hint, "__metadata__", ())
    for inner in get_args(hint):
        yield from _metadata(inner)


def _read_type(hint: object) -> tuple[Type, ParameterMode, bool]:
    """Type, mode, and whether the evaluation is deferred, of one annotation."""
    if isinstance(hint, type) and issubclass(hint, tuple):
        return record_of(hint), ParameterMode.IN, False
    origin = get_origin(hint)
    if origin is list:
        return _array_of(hint), ParameterMode.IN, False
    if origin is not Annotated:
        raise TypeError(f"{hint!r} says no RAPID type")
    inner, *metadata = get_args(hint)
    mode = next((found for found in metadata if isinstance(found, ParameterMode)), ParameterMode.IN)
    deferred = Marker.DEFERRED in metadata
    for found in metadata:
        if isinstance(found, types.Atomic | types.Alias):
            return found, mode, deferred
    if deferred:
        _, inner = get_args(inner)
    elif get_origin(inner) is Reference:
        (inner,) = get_args(inner)
    return _read_type(inner)[0], mode, deferred


def _array_of(hint: object) -> types.ArrayOf:
    dimensions = 0
    while get_origin(hint) is list:
        (hint,) = get_args(hint)
        dimensions += 1
    element, _, _ = _read_type(hint)
    assert not isinstance(element, types.ArrayOf)
    return types.ArrayOf(element, (None,) * dimensions)


def _concern(hint: object) -> str:
    """What of the controller an annotation asks for; empty where it is no protocol of it."""
    if hint is Controller:
        return WHOLE
    return CONCERNS.get(hint, "") if isinstance(hint, type) else ""


def _is_open(parameter: Parameter) -> bool:
    return len(parameter.types) > 1 or parameter.types == (types.ANYTYPE,)


def _folded(name: str) -> str:
    """What a RAPID name and its Python name have in common."""
    return name.replace("_", "").lower()
