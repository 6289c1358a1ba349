"""Parameters of user and installed routines in a common form for checking calls."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from rapidsim.diagnostics import Related
from rapidsim.language import types
from rapidsim.language.annotations import Only, ParameterMode
from rapidsim.language.types import Atomic, Kind, Type, resolved
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class ExpectedType:
    """Type that an expression must have, and the construct that requires it."""

    type: Type
    by: str
    """The requiring construct, for messages before "takes": "`count`", "parameter `Speed`"."""
    declared: tuple[Related, ...] = ()


@value_class(frozen=True, slots=True)
class Formal:
    """One parameter from the perspective of a call."""

    name: str
    key: str
    """Folded name."""
    types: tuple[Type, ...]
    """The accepted types, at least one."""
    mode: ParameterMode
    optional: bool
    is_switch: bool
    group: int
    """Optional parameters with the same number exclude each other; 0 excludes nothing."""
    wanted: ExpectedType
    """The first type, with its description for messages."""
    only: Only | None = None
    """Restriction of the accepted types if `anytype` is too general."""
    also: str = ""
    """Second name of a required argument that may have one of two types."""

    @property
    def keys(self) -> tuple[str, ...]:
        """Folded names by which a call may pass it."""
        return (self.key, self.also.lower()) if self.also else (self.key,)

    @property
    def spelled(self) -> str:
        r"""Notation in a call: `Speed`, `\WObj`."""
        return ("\\" if self.optional else "") + self.name

    @property
    def signal(self) -> Type | None:
        """Kind of signal that it accepts; None if it accepts no signal."""
        for of in self.types:
            target = resolved(of)
            if isinstance(target, Atomic) and target.kind is Kind.SEMI_VALUE:
                return of
        # Routines that accept signals of every kind, such as AliasIO, declare no kind; routines
        # that are not simulated are recognised by parameter names only.
        by_name = (
            types.ANYTYPE in self.types
            and self.mode is not ParameterMode.IN
            and "signal" in self.key
        )
        return types.SIGNAL_DI if self.accepts_any_signal or by_name else None

    @property
    def accepts_any_signal(self) -> bool:
        """Whether it accepts signals of every kind."""
        return self.only is not None and types.SIGNAL_DI in self.only.types


@value_class(frozen=True, slots=True)
class Callee:
    """The target of a call."""

    name: str
    parameters: tuple[Formal, ...]
    result: Type | None
    declared: tuple[Related, ...]
    is_complete: bool
    """Whether all its options are known; not certain for routines that are not simulated."""

    @property
    def order(self) -> str:
        r"""Call in the notation of manuals: `MoveL [\Conc] ToPoint [\ID] Speed [\V | \T] Zone`."""
        return " ".join([self.name, *self._parts()])

    def _parts(self) -> Iterator[str]:
        numbered = enumerate(self.parameters)
        for _, run in groupby(numbered, lambda part: part[1].group or -part[0]):
            formals = [formal for _, formal in run]
            names = " | ".join(formal.spelled for formal in formals)
            yield f"[{names}]" if formals[0].optional else names
