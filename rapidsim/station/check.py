"""The table [check] of a station file, or of pyproject.toml: settings of `rapidsim check`."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rapidsim.diagnostics import Severity
from rapidsim.files import input_bytes, require_inside
from rapidsim.station.toml_reader import Reader, Table, read_toml
from rapidsim.values import value_class

PROJECT_FILE = "pyproject.toml"

_KEYS = (
    *("select", "extend-select", "ignore", "per-file-ignores", "fail-on", "baseline"),
    *("cycle-budget", "assume-missing", "strict"),
)


@value_class(frozen=True, slots=True)
class CheckSettings:
    """Settings of a check. Selectors are codes, prefixes of codes, or names of rules."""

    file: Path | None = None
    """File of the settings; None for the defaults."""
    select: tuple[str, ...] = ()
    """Rules to check; empty for those that are on by default."""
    extend_select: tuple[str, ...] = ()
    """Additional rules."""
    ignore: tuple[str, ...] = ()
    """Excluded rules."""
    per_file_ignores: tuple[tuple[str, tuple[str, ...]], ...] = ()
    """Patterns such as `*Data.mod`, with the rules excluded in files whose name or path matches."""
    fail_on: Severity | None = None
    """Lowest severity that sets exit code 1; None for warnings."""
    baseline: Path | None = None
    """File of known findings."""
    cycle_budget_s: float | None = None
    """Time limit [s] of one cycle of main; beyond it `check` reports a finding, `run` fails."""
    assume_missing: bool = False
    """Whether undeclared names are assumed to exist."""
    strict: bool = False
    """Whether unknown, unsimulated and unchecked parts fail, too."""

    @property
    def fails_from(self) -> Severity:
        """Lowest severity that fails a check."""
        return self.fail_on or Severity.WARNING


def read_check(reader: Reader, check: Table, path: str = "check") -> CheckSettings:
    """Read the table; errors are collected in the reader."""
    reader.note_unknown_keys(path, check, _KEYS)
    ignores = reader.table(check, "per-file-ignores", f"{path}.per-file-ignores")
    baseline = reader.text(check, path, "baseline")
    return CheckSettings(
        file=reader.file,
        select=reader.texts(check, path, "select"),
        extend_select=reader.texts(check, path, "extend-select"),
        ignore=reader.texts(check, path, "ignore"),
        per_file_ignores=tuple(
            (pattern, reader.texts(ignores, f"{path}.per-file-ignores", pattern))
            for pattern in ignores
        ),
        fail_on=_severity(reader, check, path),
        baseline=None if baseline is None else reader.inside(baseline, f"{path}.baseline"),
        cycle_budget_s=reader.positive(check, path, "cycle-budget"),
        assume_missing=reader.flag(check, path, "assume-missing"),
        strict=reader.flag(check, path, "strict"),
    )


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


def _severity(reader: Reader, check: Table, path: str) -> Severity | None:
    text = reader.text(check, path, "fail-on")
    if text is None:
        return None
    names = [severity.value for severity in Severity]
    if text not in names:
        reader.wrong(f"{path}.fail-on", f"`{text}` is not a severity", f"known: {', '.join(names)}")
        return None
    return Severity(text)
