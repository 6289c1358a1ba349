"""`docs/rules.md` and `docs/rules/` are what the rules say now."""

from pathlib import Path

from wrap_markdown import wrap

from rapidsim.diagnostics import all_rules
from rapidsim.report.pages.rules_page import FAMILIES, rules_pages

DOCS = Path(__file__).parents[2] / "docs"


def test_the_pages_are_current() -> None:
    pages = {name: wrap(page) for name, page in rules_pages(all_rules()).items()}
    written = {"rules.md", *(f"rules/{file.name}" for file in (DOCS / "rules").iterdir())}
    message = "run `python scripts/build_rules_page.py`"
    assert {name: (DOCS / name).read_text("utf-8") for name in sorted(written)} == pages, message


def test_every_family_has_a_heading_and_every_rule_a_page() -> None:
    pages = rules_pages(all_rules())
    assert {rule.code[0] for rule in all_rules()} <= FAMILIES.keys()
    for rule in all_rules():
        assert pages[f"rules/{rule.code}.md"].startswith(f"# {rule.code} {rule.name}\n")
        assert pages["rules.md"].count(f"(rules/{rule.code}.md)") == 1
