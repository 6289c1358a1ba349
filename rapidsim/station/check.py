"""The table [check] of a station file, or of pyproject.toml: settings of `rapidsim check`."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

from rapidsim.diagnostics import Severity
from rapidsim.files import input_bytes, require_inside
from rapidsim.json_records.declarations import AboveZero, Key, noun
from rapidsim.station.declared_tables import ReadBy, values_of
from rapidsim.station.toml_reader import Reader, Table, read_toml
from rapidsim.values import value_class

PROJECT_FILE = "pyproject.toml"


def _per_file_ignores(
    reader: Reader, check: Table, path: str, key: str
) -> tuple[tuple[str, tuple[str, ...]], ...]:
    path = f"{path}.{key}"
    table = reader.table(check, key, path)
    return tuple((pattern, reader.texts(table, path, pattern)) for pattern in table)


@value_class(frozen=True, slots=True)
class CheckTable:
    """The table [check]. Selectors are codes, prefixes of codes, or names of rules."""

    select: tuple[str, ...] = ()
    """Rules to check; empty for those that are on by default."""
    extend_select: Annotated[tuple[str, ...], Key("extend-select")] = ()
    """Additional rules."""
    ignore: tuple[str, ...] = ()
    """Excluded rules."""
    per_file_ignores: Annotated[
        tuple[tuple[str, tuple[str, ...]], ...], Key("per-file-ignores"), ReadBy(_per_file_ignores)
    ] = ()
    """Patterns such as `*Data.mod`, with the rules excluded in files whose name or path matches."""
    fail_on: Annotated[Severity | None, Key("fail-on"), noun("a severity", folds_case=False)] = None
    """Lowest severity that sets exit code 1; None for warnings."""
    baseline: Path | None = None
    """File of known findings."""
    cycle_budget_s: Annotated[AboveZero | None, Key("cycle-budget")] = None
    """Time limit [s] of one cycle of main; beyond it `check` reports a finding, `run` fails."""
    assume_missing: Annotated[bool, Key("assume-missing")] = False
    """Whether undeclared names are assumed to exist."""
    strict: bool = False
    """Whether unknown, unsimulated and unchecked parts fail, too."""


@value_class(frozen=True, slots=True)
class CheckSettings(CheckTable):
    """Settings of a check."""

    file: Path | None = None
    """File of the settings; None for the defaults."""

    @property
    def fails_from(self) -> Severity:
        """Lowest severity that fails a check."""
        return self.fail_on or Severity.WARNING


def read_check(reader: Reader, check: Table, path: str = "check") -> CheckSettings:
    """Read the table; errors are collected in the reader."""
    return CheckSettings(file=reader.file, **values_of(reader, CheckTable, check, path))


def find_project_settings(paths: Iterable[str]) -> CheckSettings | None:
    """Return the table [tool.rapidsim.check] of the nearest pyproject.toml that has one; else None.

    Raises:
        InputError: If it has unknown keys or values of the wrong type.
    """
    for path in paths:
        if path == "-" or not (place := Path(path)).exists():
            continue
        folder = place.resolve() if place.is_dir() else place.resolve().parent
        for candidate in (folder, *folder.parents):
            file = candidate / PROJECT_FILE
            if not file.is_file() or b"rapidsim" not in input_bytes(file):
                continue
            require_inside([file], [candidate])
            reader = Reader(file)
            tool = reader.table(read_toml(file), "tool")
            table = reader.table(tool, "rapidsim", "tool.rapidsim")
            if "check" not in table:
                continue
            check = reader.table(table, "check", "tool.rapidsim.check")
            settings = read_check(reader, check, "tool.rapidsim.check")
            reader.finish()
            return settings
        return None
    return None
