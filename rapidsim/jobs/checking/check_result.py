"""Result of a check. Imports no analysis, as the result may come from a cache."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import field, replace

from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.findings.runs import FAMILY_OF_RUNS
from rapidsim.jobs.checking.baseline import Key, split_by_baseline
from rapidsim.jobs.inputs.robot_choice import RobotChoice
from rapidsim.notebook import card
from rapidsim.reach.checked_moves import Coverage
from rapidsim.syntax import tree
from rapidsim.values import value_class

_FAMILIES_OF_MOVES = "DKM"
_SEVERITIES = tuple(Severity)
"""Severities, the worst first."""


@value_class(frozen=True, slots=True, eq=False, repr=False)
class CheckResult:
    """Findings of a check, and the moves that were not checked."""

    files: tuple[str, ...]
    """Names of the files that were read."""
    diagnostics: tuple[Diagnostic, ...]
    """Findings in order of file and position, without those known to a baseline."""
    trees: tuple[tree.File, ...]
    """The files as they were parsed, with their comments."""
    coverage: Coverage = field(default_factory=Coverage)
    """Number of moves checked for reach, limits and path, and reasons why others were not."""
    known: tuple[Diagnostic, ...] = ()
    """Findings that a baseline knows."""
    arm: RobotChoice | None = None
    """The arm on which moves were checked, the first of several, and what determined it."""
    fail_on: Severity = Severity.WARNING
    """The lowest severity that fails the check."""
    strict: bool = False
    """Whether any qualification fails the check."""

    @property
    def ok(self) -> bool:
        """Whether the check succeeds; no other code decides its exit code."""
        failing = _SEVERITIES[: _SEVERITIES.index(self.fail_on) + 1]
        if any(finding.severity in failing for finding in self.diagnostics):
            return False
        return not (self.strict and self.qualifications)

    @property
    def qualifications(self) -> tuple[str, ...]:
        """Short phrases on parts that were not checked or are not simulated."""
        return tuple(self._qualify())

    def _qualify(self) -> Iterator[str]:
        others = {one.message for one in self.diagnostics if one.violation.qualifies}
        if others:
            yield f"{len(others)} routine{'s' * (len(others) != 1)} not simulated"
        if unchecked := len(self.coverage.unchecked):
            yield f"{unchecked} of {self.coverage.moves} moves not checked"
        if paths := len(self.coverage.unchecked_paths):
            yield f"{paths} of {self.coverage.paths} paths not checked"

    @property
    def accepted(self) -> bool:
        """Whether the program could run: no finding, known or new, is an error."""
        return all(d.severity is not Severity.ERROR for d in (*self.diagnostics, *self.known))

    def against(self, known: Counter[Key]) -> CheckResult:
        """Return the result with the findings of a baseline marked as known."""
        new, old = split_by_baseline(self.diagnostics, known)
        return replace(self, diagnostics=new, known=old)

    def _repr_html_(self) -> str:
        """Card for notebooks: verdict, moves checked, findings."""
        checked = self.coverage.moves - len(self.coverage.unchecked)
        figures = {
            "files": str(len(self.files)),
            "moves checked": f"{checked} of {self.coverage.moves}",
            **(
                {"with qualifications": "; ".join(self.qualifications)}
                if self.qualifications
                else {}
            ),
        }
        rows = [
            (one.severity.value, one.code, f"{one.file or ''}:{one.line or ''}", one.message)
            for one in self.diagnostics
        ]
        heads = ("severity", "code", "place", "message")
        title = "Check passed" if self.ok else "Check failed"
        return card(title, figures, heads=heads, rows=rows)

    def __repr__(self) -> str:
        """One line."""
        count = len(self.diagnostics)
        verdict = "accepted" if self.accepted else "rejected"
        return f"<check: {verdict}, files: {len(self.files)}, diagnostics: {count}>"

    def looked_for(self, selector: str) -> bool:
        """Whether all rules that a selector covers were checked.

        Args:
            selector: A code, the prefix of a code, or the name of a rule. Rules about moves count
                only if all moves were checked.
        """
        if selector[:1].upper() == FAMILY_OF_RUNS:
            return False
        may_be_of_moves = selector[:1].upper() in _FAMILIES_OF_MOVES or "-" in selector
        left_out = self.coverage.unchecked or self.coverage.unchecked_paths
        return not (may_be_of_moves and left_out)
