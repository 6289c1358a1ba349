"""Selection of the findings of a check: from the request, the station file and pyproject.toml."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fnmatch import fnmatch
from pathlib import Path, PurePath

from rapidsim.diagnostics import Diagnostic, Rule
from rapidsim.jobs.inputs.selectors import expect_rules, is_selected
from rapidsim.station.check import CheckSettings, find_project_settings
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Selection:
    """Rules to check and findings to show."""

    settings: CheckSettings
    select: tuple[str, ...]
    """Rules to check; empty for those that are on by default."""
    also: tuple[str, ...]
    """Additional rules."""
    ignore: tuple[str, ...]
    """Excluded rules."""

    def includes(self, rule: Rule) -> bool:
        """Whether a rule is checked."""
        return is_selected(rule, self.select, self.ignore, self.also)

    def is_looked_for(self, selector: str) -> bool:
        """Whether every check certainly examines the rules covered by a selector."""
        # Only rules that this command has neither narrowed nor widened are certainly examined.
        return not self.select and not any(
            selector.upper().startswith(one.upper()) or one.upper().startswith(selector.upper())
            for one in self.ignore
        )

    def filter(self, diagnostics: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
        """Return the findings that are shown."""
        return tuple(
            diagnostic
            for diagnostic in diagnostics
            if self.includes(diagnostic.violation.rule) and not self._is_left_out(diagnostic)
        )

    def _is_left_out(self, diagnostic: Diagnostic) -> bool:
        file = diagnostic.span.file if diagnostic.span else ""
        return any(
            any(diagnostic.violation.rule.matches(one) for one in selectors)
            and _fits(file, pattern, self.settings.file)
            for pattern, selectors in self.settings.per_file_ignores
        )


def choose_settings(paths: Sequence[str], station: CheckSettings) -> CheckSettings:
    """Return the settings of the station file; if it has none, those of the project."""
    if station != CheckSettings(file=station.file):
        return station
    return find_project_settings(paths) or station


def choose_selection(
    settings: CheckSettings,
    select: Sequence[str],
    also: Sequence[str],
    ignore: Sequence[str],
) -> Selection:
    """Return the requested selection, completed from the settings.

    Raises:
        InputError: If a selector matches no rule.
    """
    selected = tuple(select) or settings.select
    widened = (*also, *settings.extend_select)
    ignored = (*ignore, *settings.ignore)
    for_files = [one for _, codes in settings.per_file_ignores for one in codes]
    if everything := (*selected, *widened, *ignored, *for_files):
        expect_rules(everything)
    return Selection(settings, selected, widened, ignored)


def _fits(file: str, pattern: str, settings_file: Path | None) -> bool:
    """Whether a pattern matches a file: by its name, or by its path relative to the settings."""
    path = PurePath(file)
    if fnmatch(path.name.lower(), pattern.lower()):
        return True
    shown = path.as_posix()
    if settings_file is not None:
        folder, place = settings_file.parent.resolve(), Path(file).resolve()
        if place.is_relative_to(folder):
            shown = place.relative_to(folder).as_posix()
    return fnmatch(shown.lower(), pattern.lower())
