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
    """The type an expression must have, and what requires it."""

    type: Type
    by: str
    """In words that fit before "takes": "`count`", "parameter `Speed` of `MoveL`"."""
    declared: tuple[Related, ...] = ()


@value_class(frozen=True, slots=True)
class Formal:
    """One parameter as seen by a call."""

    name: str
    key: str
    """The folded name."""
    types: tuple[Type, ...]
    """The types it takes, at least one."""
    mode: ParameterMode
    optional: bool
    is_switch: bool
    group: int
    """Optional parameters with the same number exclude each other; 0 excludes nothing."""
    wanted: ExpectedType
    """The first type, with the words of messages."""
    only: Only | None = None
    """What it takes, where its type is anytype and that is too much."""
    also: str = ""
    """The other name of a required argument that may have one of two types."""

    @property
    def keys(self) -> tuple[str, ...]:
        """The folded names by which a call may pass it."""
        return (self.key, self.also.lower()) if self.also else (self.key,)

    @property
    def spelled(self) -> str:
        r"""As written in a call: `Speed`, `\WObj`."""
        return ("\\" if self.optional else "") + self.name

    @property
    def signal(self) -> Type | None:
        """The kind of signal it takes, if any."""
        for of in self.types:
            target = resolved(of)
            if isinstance(target, Atomic) and target.kind is Kind.SEMI_VALUE:
                return of
        # Routines that take signals of every kind, such as AliasIO, declare no kind; of those that
        # no run simulates, only names tell.
        by_name = (
            types.ANYTYPE in self.types
            and self.mode is not ParameterMode.IN
            and "signal" in self.key
        )
        return types.SIGNAL_DI if self.accepts_any_signal or by_name else None

    @property
    def accepts_any_signal(self) -> bool:
        """Whether it takes signals of every kind."""
        return self.only is not None and types.SIGNAL_DI in self.only.types


@value_class(frozen=True, slots=True)
class Callee:
    """The target of a call."""

    name: str
    parameters: tuple[Formal, ...]
    result: Type | None
    declared: tuple[Related, ...]
    is_complete: bool
    """Whether all its options are known; those of routines that no run simulates may not be."""

    @property
    def order(self) -> str:
        r"""The call as manuals write it: `MoveL [\Conc] ToPoint [\ID] Speed [\V | \T] Zone`."""
        return " ".join([self.name, *self._parts()])

    def _parts(self) -> Iterator[str]:
        numbered = enumerate(self.parameters)
        for _, run in groupby(numbered, lambda part: part[1].group or -part[0]):
            formals = [formal for _, formal in run]
            names = " | ".join(formal.spelled for formal in formals)
            yield f"[{names}]" if formals[0].optional else names
