"""Typed access to the tables of a TOML file, which collects errors by key."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from pathlib import Path
from typing import TypeGuard

from rapidsim.files import InputError, did_you_mean, input_text, require_inside
from rapidsim.values import value_class

Table = Mapping[str, object]


@value_class(frozen=True, slots=True)
class Reader:
    """Reader of one file; an invalid value is recorded as an error and treated as missing."""

    file: Path
    _mistakes: list[tuple[str, str | None]] = field(default_factory=list)

    def wrong(self, key: str, message: str, help: str | None = None) -> None:
        """Record an error."""
        self._mistakes.append((f"{self.file}: {key}: {message}", help))

    def inside(self, name: str, key: str) -> Path | None:
        """Return the path of a file named in this one; None if it is outside this file's folder."""
        folder = self.file.parent
        try:
            require_inside([folder / name], [folder])
        except InputError as error:
            self.wrong(key, error.message, "only what lies in the folder of this file may be named")
            return None
        return folder / name

    def finish(self) -> None:
        """Raise the errors that were recorded.

        Raises:
            InputError: With all errors, if there are any.
        """
        if not self._mistakes:
            return
        if len(self._mistakes) == 1:
            raise InputError(*self._mistakes[0])
        lines = (f"{message} ({help})" if help else message for message, help in self._mistakes)
        raise InputError("\n".join(lines))

    def note_unknown_keys(self, path: str, table: Table, keys: Iterable[str]) -> None:
        """Record the unknown keys of a table as errors."""
        keys = tuple(keys)
        for key in table:
            if key not in keys:
                help = did_you_mean(key, keys) or f"known here: {', '.join(keys)}"
                self.wrong(f"{path}.{key}" if path else key, "no such key", help)

    def table(self, values: Table, key: str, path: str | None = None) -> Table:
        """Return a table; empty if it is missing."""
        table = values.get(key, {})
        if not isinstance(table, dict):
            self.wrong(path or key, f"a table is needed, as in [{path or key}]")
            return {}
        return table

    def tables(self, values: Table, key: str) -> Iterator[tuple[str, Table]]:
        """Return the tables of a list, each with its path for messages: `stimulus 2`."""
        tables = values.get(key, [])
        if not isinstance(tables, list) or not all(isinstance(one, dict) for one in tables):
            self.wrong(key, f"they are written as [[{key}]]")
            return
        for number, table in enumerate(tables, start=1):
            yield (f"{key} {number}" if len(tables) > 1 else key), table

    def text(self, values: Table, path: str, key: str) -> str | None:
        """Return a string; None if it is missing."""
        value = values.get(key)
        if value is not None and not isinstance(value, str):
            self.wrong(f"{path}.{key}", "text in quotes is needed")
            return None
        return value

    def texts(self, values: Table, path: str, key: str) -> tuple[str, ...]:
        """Return a list of strings; empty if it is missing."""
        value = values.get(key, [])
        if not isinstance(value, list) or not all(isinstance(one, str) for one in value):
            self.wrong(f"{path}.{key}", "a list of texts is needed")
            return ()
        return tuple(value)

    def flag(self, values: Table, path: str, key: str) -> bool | None:
        """Return a flag; None if it is missing."""
        value = values.get(key)
        if value is not None and not isinstance(value, bool):
            self.wrong(f"{path}.{key}", "true or false is needed")
            return None
        return value

    def number(self, values: Table, path: str, key: str) -> float | None:
        """Return a number; None if it is missing."""
        value = values.get(key)
        if value is None:
            return None
        if not is_number(value):
            self.wrong(f"{path}.{key}", "a number is needed")
            return None
        return float(value)

    def level(self, values: Table, path: str, key: str) -> float | None:
        """Return the value of a signal, a number or a flag; None if it is missing."""
        value = values.get(key)
        return float(value) if isinstance(value, bool) else self.number(values, path, key)

    def not_negative(self, values: Table, path: str, key: str) -> float | None:
        """Return a non-negative number; None if it is missing."""
        value = values.get(key)
        if value is None:
            return None
        if not is_number(value) or value < 0.0:
            self.wrong(f"{path}.{key}", "a number that is not negative is needed")
            return None
        return float(value)

    def positive(self, values: Table, path: str, key: str) -> float | None:
        """Return a positive number; None if it is missing."""
        value = self.not_negative(values, path, key)
        if value == 0.0:
            self.wrong(f"{path}.{key}", "a number above 0 is needed")
            return None
        return value

    def numbers(
        self, values: Table, path: str, key: str, count: int | None
    ) -> tuple[float, ...] | None:
        """Return a list of `count` numbers (None: any number); None if it is missing."""
        value = values.get(key)
        if value is None:
            return None
        numbers = [one for one in value if is_number(one)] if isinstance(value, list) else []
        if not numbers or numbers != value:
            self.wrong(f"{path}.{key}", "a list of numbers is needed")
            return None
        if count is not None and len(numbers) != count:
            self.wrong(f"{path}.{key}", f"{count} numbers are needed, not {len(numbers)}")
            return None
        return tuple(float(one) for one in numbers)


def read_toml(file: Path) -> Table:
    """Return the top-level table of a TOML file.

    Raises:
        InputError: If it is missing or not TOML.
    """
    try:
        return tomllib.loads(input_text(file))
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{file} is not TOML: {error}") from error
    except ValueError as error:
        raise InputError(f"{file} holds a number with too many digits") from error
    except RecursionError:
        raise InputError(f"{file} is nested too deeply") from None


def as_toml(value: object) -> object:
    """Return a value with lists and dicts for sequences and mappings, as TOML has them."""
    match value:
        case Mapping():
            return {str(key): as_toml(one) for key, one in value.items()}
        case list() | tuple():
            return [as_toml(one) for one in value]
        case _:
            return value


def is_number(value: object) -> TypeGuard[float]:
    """Whether a TOML value is a finite number."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        # An integer that exceeds the range of a float.
        return False
