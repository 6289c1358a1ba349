"""The table of installed routines: one row a routine, read by checker, interpreter and docs.

A row names a typed Python function; its annotations are the RAPID signature (see
`language.annotations`). Reading annotations costs time, so a signature is read when first asked.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from rapidsim.language.annotations import Mode
from rapidsim.language.types import Type


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter of an installed routine."""

    name: str
    """As RAPID spells it: `MaxTime`."""
    python: str
    """As the Python function spells it: `max_time`."""
    types: tuple[Type, ...]
    """The types it takes; several where RAPID has alternatives such as `Name | Dname`."""
    mode: Mode = Mode.IN
    optional: bool = False
    is_switch: bool = False
    group: int = 0
    """Optional parameters with the same number above 0 exclude each other."""


@dataclass(frozen=True, slots=True)
class Signature:
    """Parameters in call order; `result` is None for an instruction.

    `takes_controller` says that the Python function wants the controller first.
    """

    parameters: tuple[Parameter, ...]
    result: Type | None
    takes_controller: bool


@dataclass(frozen=True, eq=False)
class LibraryRoutine:
    """A row of the table."""

    name: str
    body: Callable[..., Any]
    alternatives: tuple[tuple[str, ...], ...] = ()
    """Groups of optional parameters (Python names) that exclude each other."""
    treated_as: str | None = None
    """What is done instead where the routine is not simulated; None where it is."""

    @property
    def simulated(self) -> bool:
        """Whether the routine does what the controller's does."""
        return self.treated_as is None

    @cached_property
    def signature(self) -> Signature:
        """The RAPID signature, read from the function's annotations."""
        raise NotImplementedError
