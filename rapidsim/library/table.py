r"""Table of installed routines: one row per routine, read by checker, interpreter and docs.

A row names a typed Python function; its annotations are the RAPID signature (see
`language.annotations`). Python cannot express options before required arguments, or options that
exclude each other; a row declares these in `order`, in RAPID's own spelling:
`\SDelay|\Sync Signal Value`. From a group of options (`**options`) a row has the ones in its
order. Reading annotations costs time, so a signature is read on first use.
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
"""RAPID names that differ from the capitalised Python name."""
WHOLE = "controller"
"""Marker for the whole controller instead of one of its concerns."""


@value_class(frozen=True, slots=True)
class Parameter:
    """One parameter of an installed routine."""

    name: str
    """Name in RAPID: `MaxTime`."""
    python: str
    """Name in Python: `max_time`."""
    types: tuple[Type, ...]
    """The accepted types; several for RAPID's alternatives such as `Name | Dname`."""
    mode: ParameterMode = ParameterMode.IN
    optional: bool = False
    by_keyword: bool = False
    """Whether the Python function takes the parameter by keyword, as all optional ones."""
    is_switch: bool = False
    group: int = 0
    """Group of an optional parameter: those with the same number above 0 exclude each other."""
    deferred: bool = False
    """Whether the Python function takes a function that evaluates the argument."""
    only: Only | None = None
    """Restriction of the accepted types if `anytype` is too general."""
    also: str = ""
    """Second name of a required argument that may have one of two types: `Dvalue`."""


@value_class(frozen=True, slots=True)
class Signature:
    """Parameters in call order; `result` is None for an instruction.

    The Python function takes its arguments by position in this order, except those `by_keyword`.
    """

    parameters: tuple[Parameter, ...]
    result: Type | None
    concern: str = ""
    """Controller service that the Python function takes first, by name; `controller` for the whole
    controller; empty for none.
    """
    types_of: tuple[tuple[str, Parameter], ...] = ()
    """Keywords under which the Python function takes the types of these parameters' arguments."""
    is_open: bool = False
    """Whether the parameters are undocumented: the function is called without any argument."""

    @property
    def takes_controller(self) -> bool:
        """Whether the Python function takes the controller, or a service of it, first."""
        return bool(self.concern)

    def concern_of(self, controller: Controller) -> object:
        """First argument of the Python function: the controller or one of its services."""
        return controller if self.concern == WHOLE else getattr(controller, self.concern)


@value_class(frozen=True, eq=False)
class LibraryRoutine:
    """A row of the table."""

    name: str
    function: Callable[..., Any]
    """The function as written; `body` is called instead."""
    order: str = ""
    """The parameters in RAPID's order and spelling, options with a backslash, alternatives with a
    bar; needed only if options come first, exclude each other, or a name is unusual or has a
    second.
    """
    treated_as: str | None = None
    """Replacement of a routine that is not simulated; None if it is simulated."""
    stated: Trait = NO_TRAITS
    """Traits that the row states; `traits` has all."""
    sets: tuple[str, ...] = ()
    """Fields of `MotionSettings` that the routine sets."""
    takes_anything: bool = False
    """Whether a call may have undocumented arguments; the function gets none."""
    back: str = ""
    """The call that restores the initial mode, if the routine changes a mode that can outlast the
    caller: the switch or the percentages in it count, otherwise the routine of that name.
    """

    @property
    def simulated(self) -> bool:
        """Whether the routine is simulated as on a controller."""
        return self.treated_as is None

    @cached_property
    def signature(self) -> Signature:
        """The RAPID signature, read from the function's annotations."""
        signature = _read_signature(self.function, self.order)
        return replace(signature, is_open=True) if self.takes_anything else signature

    @cached_property
    def traits(self) -> Trait:
        """All traits of a call."""
        names = frozenset(p.name.lower() for p in self.signature.parameters)
        return derived(self.stated, names)

    @property
    def limit(self) -> str | None:
        """Option that limits the waiting time, in RAPID's spelling; None without one."""
        found = (p.name for p in self.signature.parameters if p.optional)
        return next((name for name in found if name.lower() in LIMITS), None)

    @cached_property
    def body(self) -> Callable[..., Any]:
        """The Python function, with results rounded to single precision."""
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
    """Build a row of a table; traits that follow from its parameters need not be stated."""
    return LibraryRoutine(name, body, order, treated_as, does, sets, takes_anything, back)


def table(*rows: LibraryRoutine) -> Mapping[str, LibraryRoutine]:
    """Build a read-only table by folded name."""
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
    """Type of the data that a routine may write through a parameter; None if it writes none.

    None also for several types, and for an array, whose elements are written one by one.
    """
    writes = parameter.mode in (ParameterMode.INOUT, ParameterMode.VAR) and not _is_open(parameter)
    of = parameter.types[0]
    return of if writes and not isinstance(types.resolved(of), types.ArrayOf) else None


def _ordered(read: dict[str, Parameter], order: str) -> tuple[Parameter, ...]:
    """Parameters in RAPID's order and spelling, alternatives grouped."""
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
    """Yield the metadata next to the type in an annotation, also inside references and options."""
    yield from getattr(hint, "__metadata__", ())
    for inner in get_args(hint):
        yield from _metadata(inner)


def _read_type(hint: object) -> tuple[Type, ParameterMode, bool]:
    """Parse an annotation into type, mode, and whether its evaluation is deferred."""
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
    """Name of the controller service that an annotation requests; empty if it requests none."""
    if hint is Controller:
        return WHOLE
    return CONCERNS.get(hint, "") if isinstance(hint, type) else ""


def _is_open(parameter: Parameter) -> bool:
    return len(parameter.types) > 1 or parameter.types == (types.ANYTYPE,)


def _folded(name: str) -> str:
    """Common form of a RAPID name and its Python name."""
    return name.replace("_", "").lower()
