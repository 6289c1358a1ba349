"""All rules as one page of Markdown: `docs/rules.md`."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from rapidsim.diagnostics import Rule
from rapidsim.report.pages.rules import explanation, first_line, shown_programs

FAMILIES = {
    "E": "syntax and text",
    "N": "names",
    "T": "types and numbers",
    "F": "flow",
    "M": "data of motion",
    "K": "reach and configuration",
    "C": "collisions",
    "D": "cycle time",
    "I": "signals",
    "S": "house style",
    "R": "what a run meets",
}

_INTRODUCTION = """\
# Rules

What `rapidsim check` finds, and what a run meets (family R). Made from the source by
`python scripts/build_rules_page.py`; `rapidsim explain CODE` prints the same for one rule.

A code never changes its meaning. Rules marked *on request* are looked for with `--select` or
`--extend-select`. A comment `! rapidsim: ignore[CODE] reason` suppresses a finding.
"""


def rules_page(rules: Sequence[Rule]) -> str:
    """The page: a table of contents, then each rule with example and fix."""
    by_family = [
        (family, list(found)) for family, found in groupby(rules, lambda rule: rule.code[0])
    ]
    parts = [_INTRODUCTION]
    for family, found in by_family:
        parts.append(f"\n## {family}: {FAMILIES[family]}\n")
        parts += ["| rule | | finds |", "|---|---|---|"]
        parts += [_row(rule) for rule in found]
    for _, found in by_family:
        parts += [_section(rule) for rule in found]
    return "\n".join(parts) + "\n"


def _row(rule: Rule) -> str:
    first = first_line(rule).replace("|", "\\|")
    asked = "" if rule.on_by_default else ", *on request*"
    link = f"[{rule.code}](#{rule.code.lower()}-{rule.name})"
    return f"| {link} {rule.name} | {rule.severity.value}{asked} | {first} |"


def _section(rule: Rule) -> str:
    lines = [f"\n### {rule.code} {rule.name}\n", explanation(rule)]
    if rule.cf:
        lines.append(f"\nController event: {rule.cf}.")
    for heading, program in shown_programs(rule).items():
        lines.append(f"\n{heading}:\n\n```\n{program.strip()}\n```")
    return "\n".join(lines)
