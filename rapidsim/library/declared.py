r"""Routines that are declared but not simulated: `declared.txt`, read on first use.

Each line contains the header of a routine as RAPID declares it, with `...` for parameters that no
source documents; after `=>` the routine that replaces it. Without `=>` an instruction is skipped
and a function returns the initial value of its type. After `@` follow the effects that the header
does not show, in the words of `Trait`, or the routine that restores the setting. Each use is
reported to the controller.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial
from pathlib import Path
from types import MappingProxyType

from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.controller import Controller
from rapidsim.language.initial_values import initial_value
from rapidsim.language.types import Type
from rapidsim.library.motion import MOTION
from rapidsim.library.predefined import TYPES
from rapidsim.library.substitutes import SUBSTITUTES
from rapidsim.library.table import WHOLE, LibraryRoutine, Parameter, Signature
from rapidsim.library.text import value_text
from rapidsim.library.traits import NO_TRAITS, Trait

BUILT_IN = "built in"
"""Replacement after `=>` of routines that the interpreter itself executes."""

_HEADING = "! == "
_OPEN = "..."
"""Placeholder for parameters that no source documents."""
_LINE = re.compile(
    r"(?:PROC|FUNC (?P<result>\w+)) (?P<name>\w+)\((?P<parameters>[^)]*)\)"
    r"(?: => (?P<instead>[^@]+?))?(?: @ (?:back: (?P<back>\w+)|(?P<does>[A-Z_ ]+)))?"
)
_PARAMETER = re.compile(
    r"(?:(?P<mode>INOUT|VAR|PERS|REF) )?(?P<type>\w+) (?P<name>\w+)(?:\{(?P<stars>[*,]+)\})?"
)


@cache
def read_declared() -> Mapping[str, LibraryRoutine]:
    """All declared routines by folded name."""
    rows = (_row(line) for line in _lines() if line.startswith(("PROC", "FUNC")))
    return MappingProxyType({row.name.lower(): row for row in rows})


def read_declared_chapters() -> Mapping[str, tuple[str, ...]]:
    """Folded names of the declared routines by the headings of the file, in its order."""
    chapters: dict[str, list[str]] = {}
    for line in _lines():
        if line.startswith(_HEADING):
            chapters[line.removeprefix(_HEADING)] = []
        elif match := _LINE.fullmatch(line):
            list(chapters.values())[-1].append(match["name"].lower())
    return {title: tuple(names) for title, names in chapters.items()}


@dataclass(frozen=True, eq=False)
class DeclaredRoutine(LibraryRoutine):
    """A row whose signature is read from text."""

    parameters: str = ""
    result: str | None = None

    @cached_property
    def signature(self) -> Signature:
        """The signature, read from the header."""
        is_open = self.parameters == _OPEN
        return Signature(
            () if is_open else tuple(_read_parameters(self.parameters)),
            None if self.result is None else TYPES[self.result],
            "" if self.simulated else WHOLE,
            is_open=is_open,
        )


def _lines() -> list[str]:
    return Path(__file__).with_name("declared.txt").read_text("utf-8").splitlines()


def _row(line: str) -> LibraryRoutine:
    match = _LINE.fullmatch(line)
    assert match is not None, f"declared.txt: cannot read {line!r}"
    name, result, instead = match["name"], match["result"], match["instead"]
    declared = partial(
        DeclaredRoutine,
        name,
        stated=_stated(match["does"] or "", instead),
        back=match["back"] or "",
        parameters=match["parameters"],
        result=result,
    )
    if instead == BUILT_IN:
        return declared(_built_in(name))
    treated_as = instead or ("skipped" if result is None else _returned(TYPES[result]))

    def body(controller: Controller, *arguments: object, **options: object) -> object:
        controller.fidelity.not_simulated(name, treated_as)
        if (substitute := SUBSTITUTES.get(treated_as)) is not None:
            given = _by_name(row.signature, arguments) | options
            substitute(controller, given)
        return None if result is None else initial_value(TYPES[result])

    row = declared(body, treated_as=treated_as)
    return row


def _stated(words: str, replacement: str | None) -> Trait:
    """Traits that a line declares for a routine, joined with those of the move that replaces it."""
    substitute = MOTION.get((replacement or "").lower())
    does = NO_TRAITS if substitute is None else substitute.stated
    for word in words.split():
        does |= Trait[word]
    return does


def _built_in(name: str) -> Callable[..., object]:
    def body(*arguments: object, **options: object) -> object:
        raise AssertionError(f"{name} is carried out by the interpreter, not called")

    return body


def _returned(result: Type) -> str:
    value = initial_value(result)
    return "returns nothing" if value is None else f"returns {value_text(value, result)}"


def _by_name(signature: Signature, arguments: tuple[object, ...]) -> dict[str, object]:
    required = (p.python for p in signature.parameters if not p.by_keyword)
    return dict(zip(required, arguments, strict=True))


def _read_parameters(text: str) -> list[Parameter]:
    """Parse parameters: commas separate required ones, a backslash begins an option."""
    parameters: list[Parameter] = []
    group = 0
    for item in re.findall(r"\\?[^\\,{]+(?:\{[*,]+\}[^\\,{]*)*", text):
        optional = item.startswith("\\")
        alternatives = [_parameter(a, optional) for a in item.lstrip("\\").split("|")]
        if not optional:
            parameters.append(_merged(alternatives))
            continue
        group += len(alternatives) > 1
        shared = group if len(alternatives) > 1 else 0
        parameters += (replace(alternative, group=shared) for alternative in alternatives)
    return parameters


def _merged(alternatives: list[Parameter]) -> Parameter:
    """Merge alternatives into one required parameter of either type.

    Example: `VAR signaldi Signal | PERS bool PersBool`.
    """
    first = alternatives[0]
    modes = {alternative.mode for alternative in alternatives}
    mode = (
        first.mode
        if len(modes) == 1
        else ParameterMode.IN
        if ParameterMode.IN in modes
        else ParameterMode.INOUT
    )
    of = tuple(found for alternative in alternatives for found in alternative.types)
    return Parameter(first.name, first.python, of, mode)


def _parameter(text: str, optional: bool) -> Parameter:
    match = _PARAMETER.fullmatch(text.strip())
    assert match is not None, f"declared.txt: cannot read the parameter {text!r}"
    of = TYPES[match["type"]]
    if match["stars"]:
        assert not isinstance(of, types.ArrayOf)
        of = types.ArrayOf(of, (None,) * match["stars"].count("*"))
    mode = ParameterMode[match["mode"]] if match["mode"] else ParameterMode.IN
    name = match["name"]
    return Parameter(name, name.lower(), (of,), mode, optional, optional, of == types.SWITCH)
