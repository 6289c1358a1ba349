"""Write a run as one HTML file: text, style, drawing code and numbers all in it.

The page opens from disk and fetches nothing, so it can be mailed and kept. It holds no date: the
same run gives the same file.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from rapidsim.colours import style_variables
from rapidsim.diagnostics import Diagnostic
from rapidsim.output_files import whole_file
from rapidsim.report.html import sections
from rapidsim.report.html.collision_section import collision_section
from rapidsim.report.html.elements import text
from rapidsim.report.html.error_section import error_section
from rapidsim.report.html.motion_data import motion_data
from rapidsim.report.run.figures import figures
from rapidsim.shipped import filled, shipped
from rapidsim.simulation.results.simulation import Simulation

_SCRIPTS = ("data.js", "plot.js", "lanes.js", "path.js", "links.js", "arm.js", "page.js")


def write_report(simulation: Simulation, findings: Sequence[Diagnostic], path: str | Path) -> Path:
    """Write the report of a run.

    Args:
        simulation: The run.
        findings: What checking and running found.
        path: Where to write; the file appears only when it is complete.

    Returns:
        The path written.

    Raises:
        InputError: When nothing can be written there.
    """
    path = Path(path)
    page = report_page(simulation, findings)
    with whole_file(path) as temporary:
        temporary.write_text(page, encoding="utf-8", newline="\n")
    return path


def report_page(simulation: Simulation, findings: Sequence[Diagnostic]) -> str:
    """The page as text."""
    parts = {
        "title": text(simulation.title),
        "style": style_variables(":root.dark") + _shipped("style.css"),
        "head": sections.head(simulation),
        "summary": sections.summary(simulation, figures(simulation), findings),
        "findings": sections.findings(findings),
        "errors": error_section(simulation),
        "collisions": collision_section(simulation),
        "times": sections.cycle_time(simulation),
        "events": sections.events(simulation),
        "models": sections.assumptions(simulation),
        "data": _json(motion_data(simulation)),
        "script": "\n".join(_shipped(name) for name in _SCRIPTS),
    }
    return filled(_shipped("page.html"), parts)


def _json(value: object) -> str:
    """JSON for a script element: nothing in it ends the element."""
    compact = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return compact.replace("<", "\\u003c")


def _shipped(name: str) -> str:
    return (shipped("report/html/shipped") / name).read_text(encoding="utf-8")
