"""The page that jogs an arm: its files, and what answers its requests."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from secrets import token_urlsafe
from typing import Final

from rapidsim.applications.jog.jog_answers import JogAnswers
from rapidsim.applications.jog.jog_cell import JogCell
from rapidsim.applications.jog.taught_targets import TaughtModules
from rapidsim.server.http.local_page import LocalPage
from rapidsim.server.http.operator_page import script

_FOLDER: Final = Path(__file__).with_name("shipped")
_SCRIPT, _STYLE = "text/javascript", "text/css"


def page_key() -> str:
    """Return a secret that nobody guesses."""
    return token_urlsafe(16)


def jog_page(cell: JogCell) -> LocalPage:
    """Return the page of an arm in its cell."""
    answers, modules = JogAnswers(cell), TaughtModules(cell.files)

    def teach(fields: Mapping[str, str]) -> dict[str, object]:
        target = answers.taught(fields)
        written = modules.write(fields.get("module", ""), fields.get("name", ""), target)
        return {"file": written.file, "line": written.line}

    own = {
        "": ("jog_page.html", "text/html"),
        "jog_page.js": ("jog_page.js", _SCRIPT),
        "jog_page.css": ("jog_page.css", _STYLE),
    }
    shared = {"links.js": _SCRIPT, "arm.js": _SCRIPT, "jog.js": _SCRIPT, "style.css": _STYLE}
    return LocalPage(
        files={name: ((_FOLDER / file).read_bytes(), kind) for name, (file, kind) in own.items()}
        | {name: (script(name), kind) for name, kind in shared.items()},
        reads={
            "start": answers.start,
            "standing": answers.standing,
            "steps": answers.steps,
            "move": answers.move,
            "branches": answers.branches,
        },
        changes={"teach": teach},
    )
