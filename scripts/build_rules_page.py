"""Write the pages of the rules, `docs/rules.md` and `docs/rules/`, from the source.

python scripts/build_rules_page.py
"""

from __future__ import annotations

from pages_of_folder import write_pages

from rapidsim.diagnostics import all_rules
from rapidsim.report.pages.rules_page import rules_pages


def main() -> None:
    """Write the pages."""
    write_pages(rules_pages(all_rules()), "rules")


if __name__ == "__main__":
    main()
