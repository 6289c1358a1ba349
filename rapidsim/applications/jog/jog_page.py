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
from rapidsim.server.http.page_files import framed, page_file

_FOLDER: Final = Path(__file__).with_name("shipped")
_SCRIPTS: Final = ("links.js", "arm.js", "jog.js", "jog_page.js")
_STYLES: Final = ("style.css", "jog_page.css")


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

    content = _own("jog_page.html")
    page = framed("rapidsim jog", content, _STYLES, _SCRIPTS)
    kinds = dict.fromkeys(_STYLES, "text/css") | dict.fromkeys(_SCRIPTS, "text/javascript")
    return LocalPage(
        files={name: (_own(name), kind) for name, kind in kinds.items()}
        | {"": (page, "text/html")},
        reads={
            "start": answers.start,
            "standing": answers.standing,
            "steps": answers.steps,
            "move": answers.move,
            "branches": answers.branches,
        },
        changes={"teach": teach},
    )


def _own(name: str) -> bytes:
    """Return a file of this page, or of all pages."""
    file = _FOLDER / name
    return file.read_bytes() if file.is_file() else page_file(name)
