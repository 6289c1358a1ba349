"""Files of the pages for browsers: their headers, their common frame, scripts and styles."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Final

from rapidsim.colours import style_variables
from rapidsim.report import html
from rapidsim.shipped import filled

_FOLDER: Final = Path(__file__).with_name("shipped")
_SHARED: Final = Path(html.__file__).parent / "shipped"
"""Folder of the scripts that reports have as well."""
HEADERS: Final = MappingProxyType(
    {
        "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; "
        "connect-src 'self'; img-src data:; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'",
        "X-Content-Type-Options": "nosniff",
        "Referrer-Policy": "no-referrer",
        "Cache-Control": "no-store",
    }
)
"""Headers of a page that loads nothing of others and is shown in no frame of theirs."""


@cache
def page_file(name: str) -> bytes:
    """Return a file of the pages, or of the reports."""
    file = _FOLDER / name
    content = (file if file.is_file() else _SHARED / name).read_bytes()
    return style_variables().encode() + content if name == "style.css" else content


def framed(title: str, content: bytes, styles: Iterable[str], scripts: Iterable[str]) -> bytes:
    """Return a page.

    Args:
        title: Its title.
        content: Its body as HTML.
        styles: Addresses of its styles.
        scripts: Addresses of its scripts.
    """
    parts = {
        "title": title,
        "styles": "\n".join(f'<link rel="stylesheet" href="{one}">' for one in styles),
        "content": content.decode(),
        "scripts": "\n".join(f'<script src="{one}"></script>' for one in scripts),
    }
    return filled(page_file("frame.html").decode(), parts).encode()
