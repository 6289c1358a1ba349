"""Write `docs/rules.md` from the pages of the rules: `python scripts/build_rules_page.py`."""

from __future__ import annotations

from pathlib import Path

from rapidsim.diagnostics import all_rules
from rapidsim.report.pages.rules_page import rules_page

PAGE = Path(__file__).parents[1] / "docs" / "rules.md"


def main() -> None:
    """Write the page."""
    PAGE.write_text(rules_page(all_rules()), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
