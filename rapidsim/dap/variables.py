"""Trees of values as the client unfolds them: scopes, records, arrays."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from rapidsim.analysis.literals import element_type
from rapidsim.dap.wire import Message
from rapidsim.interpreter.tools.inspection import NotShownError
from rapidsim.language.types import ArrayOf, Record, Type, resolved
from rapidsim.library.text import value_text
from rapidsim.values import value_class

_LONGEST = 200
"""Characters of a value in a list; the whole is shown when it is unfolded."""
_MOST_CHILDREN = 1000


@value_class(frozen=True, slots=True)
class Variable:
    """One line of a tree."""

    name: str
    text: str
    type: str = ""
    path: str = ""
    """Expression that evaluates to it; "" if there is none."""
    children: Callable[[], Iterable[Variable]] | None = None


@dataclass(eq=False)
class Handles:
    """Numbers by which the client refers to what it can unfold, until the program goes on."""

    _children: list[Callable[[], Iterable[Variable]]] = field(default_factory=list)

    def clear(self) -> None:
        """Forget all."""
        self._children.clear()

    def number(self, children: Callable[[], Iterable[Variable]] | None) -> int:
        """Number of something that can be unfolded; 0 for what cannot."""
        if children is None:
            return 0
        self._children.append(children)
        return len(self._children)

    def unfolded(self, number: int) -> list[Message]:
        """The lines below a number.

        Raises:
            LookupError: If the number is of an earlier stop.
        """
        if not 1 <= number <= len(self._children):
            raise LookupError("these values are of an earlier stop")
        return [self.line(one) for one in self._children[number - 1]()]

    def path(self, number: int, name: str) -> str:
        """Expression for one of the lines below a number.

        Raises:
            LookupError: If there is none.
        """
        if 1 <= number <= len(self._children):
            for one in self._children[number - 1]():
                if one.name == name and one.path:
                    return one.path
        raise LookupError(f"`{name}` cannot be set")

    def line(self, variable: Variable) -> Message:
        """One line for the client."""
        return {
            "name": variable.name,
            "value": variable.text,
            "type": variable.type,
            "evaluateName": variable.path,
            "variablesReference": self.number(variable.children),
        }


def variable(name: str, value: object, of: Type, path: str) -> Variable:
    """The line of a value, whose components or elements can be unfolded."""
    try:
        text = value_text(value, of)
    except TypeError:
        text = of.name
    except NotShownError as error:
        text = f"({error})"
    shown = text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."
    has_children = isinstance(resolved(of), Record | ArrayOf) and isinstance(value, tuple | list)
    return Variable(
        name, shown, of.name, path, (lambda: _parts(value, of, path)) if has_children else None
    )


def _parts(value: object, of: Type, path: str) -> Iterable[Variable]:
    known = resolved(of)
    if isinstance(known, Record) and isinstance(value, tuple):
        for part, component in zip(value, known.components, strict=True):
            yield variable(component.name, part, component.type, f"{path}.{component.name}")
    elif isinstance(known, ArrayOf) and isinstance(value, list):
        # Indices of several dimensions stand in one pair of braces.
        prefix = path.removesuffix("}") + "," if path.endswith("}") else f"{path}{{"
        for number, part in enumerate(value[:_MOST_CHILDREN], 1):
            yield variable(f"[{number}]", part, element_type(known), f"{prefix}{number}}}")
