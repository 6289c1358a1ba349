"""`docs/rules.md` is what the rules say now."""

from pathlib import Path

from rapidsim.diagnostics import all_rules
from rapidsim.report.pages.rules_page import FAMILIES, rules_page

PAGE = Path(__file__).parents[2] / "docs" / "rules.md"


def test_the_page_is_current() -> None:
    message = "run `python scripts/build_rules_page.py`"
    assert PAGE.read_text("utf-8") == rules_page(all_rules()), message


def test_every_family_has_a_heading_and_every_rule_a_section() -> None:
    page = rules_page(all_rules())
    assert {rule.code[0] for rule in all_rules()} <= FAMILIES.keys()
    for rule in all_rules():
        assert page.count(f"\n### {rule.code} {rule.name}\n") == 1
        assert page.count(f"(#{rule.code.lower()}-{rule.name})") == 1
