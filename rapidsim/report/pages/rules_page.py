"""All rules as pages of Markdown: `docs/rules.md` lists them, `docs/rules/` has a page for each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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

What `rapidsim check` finds, and what a run meets (family R). Each code has a page with an example
and its fix. Made from the source by `python scripts/build_rules_page.py`; `rapidsim explain CODE`
prints the same.

A code never changes its meaning. Rules marked *on request* are looked for with `--select` or
`--extend-select`. A comment `! rapidsim: ignore[CODE] reason` suppresses a finding.
"""


def rules_pages(rules: Sequence[Rule]) -> Mapping[str, str]:
    """Return the pages by path below `docs`: the list, then a page for each rule."""
    pages = {f"rules/{rule.code}.md": _page(rule) for rule in rules}
    return {"rules.md": _list(rules), **pages}


def _list(rules: Sequence[Rule]) -> str:
    parts = [_INTRODUCTION]
    for family, found in groupby(rules, lambda rule: rule.code[0]):
        parts.append(f"\n## {family}: {FAMILIES[family]}\n")
        parts += ["| rule | | finds |", "|---|---|---|"]
        parts += [_row(rule) for rule in found]
    return "\n".join(parts) + "\n"


def _row(rule: Rule) -> str:
    first = first_line(rule).replace("|", "\\|")
    link = f"[{rule.code}](rules/{rule.code}.md)"
    return f"| {link} {rule.name} | {_severity(rule)} | {first} |"


def _page(rule: Rule) -> str:
    lines = [
        f"# {rule.code} {rule.name}\n",
        f"{_severity(rule).capitalize()}.\n",
        explanation(rule),
    ]
    if rule.cf:
        lines.append(f"\nController event: {rule.cf}.")
    for heading, program in shown_programs(rule).items():
        lines.append(f"\n## {heading}\n\n```rapid\n{program.strip()}\n```")
    lines.append("\n[All rules](../rules.md)")
    return "\n".join(lines) + "\n"


def _severity(rule: Rule) -> str:
    return f"{rule.severity.value}{'' if rule.on_by_default else ', *on request*'}"
