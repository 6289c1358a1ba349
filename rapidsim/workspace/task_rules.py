"""The findings of rules in a task, kept by routine as long as they cannot change."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rapidsim.analysis.context import Analysis
from rapidsim.analysis.passes.checker import Find
from rapidsim.analysis.passes.versions import find_newer
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.table import RuleScope, scope_of, violations_of
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.workspace.file_units import FileUnits


class TaskRules:
    """The detectors of a workspace, by the text on which their findings depend."""

    def __init__(self, rules: Sequence[Find]) -> None:
        """Take the detectors."""
        scopes = {rule: scope_of(rule) for rule in rules}
        self._rank: dict[type[Violation], int] = {}
        for number, rule in enumerate(rules):
            for kind in violations_of(rule):
                self._rank.setdefault(kind, number)
        self._of_text = [rule for rule in rules if scopes[rule] is RuleScope.TEXT]
        self._of_file = [rule for rule in rules if scopes[rule] is RuleScope.FILE]
        self._of_routine = [rule for rule in rules if scopes[rule] is RuleScope.ROUTINE]
        self._of_task = [rule for rule in rules if scopes[rule] is RuleScope.TASK]

    def rank(self, finding: Diagnostic) -> int:
        """The number of the detector of a finding; -1 for findings of the check itself."""
        return self._rank.get(type(finding.violation), -1)

    def in_file(self, file: FileUnits) -> list[Diagnostic]:
        """Findings that depend on the characters of one file, at their offsets in it."""
        source = file.source.written
        written = parse(source).file if self._of_file else tree.File(source, (), ())
        facts = Facts((written,), Analysis())
        return [one for rule in (*self._of_text, *self._of_file) for one in rule(facts)]

    def in_task(self, facts: Facts) -> Iterator[Diagnostic]:
        """Findings that depend on more than one file, and those of each part."""
        for part in facts.parts:
            yield from facts.of_part(self._in_part, part)
        for rule in self._of_task:
            yield from rule(facts)

    def _in_part(self, part: ProgramPart, facts: Facts) -> list[Diagnostic]:
        alone = facts.only(part)
        return [one for rule in (find_newer, *self._of_routine) for one in rule(alone)]
