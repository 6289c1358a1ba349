"""Write a recording as a page that any browser opens, from a disk or a web server.

Viewer and recording are in the page, which fetches nothing: its content security policy forbids
it. The viewer's program is compressed and unpacked by the browser.
"""

from __future__ import annotations

import gzip
from base64 import b64encode
from html import escape
from pathlib import Path

from rapidsim.files import InputError, input_bytes
from rapidsim.output_files import whole_file
from rapidsim.recording.page.viewer_files import ViewerFiles, viewer_files
from rapidsim.shipped import filled

_PAGE, _NOTICES = "index.html", "THIRD_PARTY_NOTICES.md"
_MOST_BYTES = 250_000_000
"""Largest recording [bytes] whose page browsers open."""


def write_page(recording: Path, folder: Path) -> Path:
    """Write a page with a recording, and the viewer's licences beside it.

    Args:
        recording: The recording, a file of the installed version of rerun.
        folder: The folder, which is made if it is missing.

    Returns:
        The page.

    Raises:
        InputError: If the recording is too large or unreadable, the viewer does not serve its
            files, or nothing can be written there.
    """
    size = recording.stat().st_size
    if size > _MOST_BYTES:
        raise InputError(
            f"{recording} has {size / 1e6:.0f} MB; browsers open pages with at "
            f"most {_MOST_BYTES / 1e6:.0f} MB",
            "record with a larger --dt",
        )
    viewer, data = viewer_files(), input_bytes(recording)
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot make the folder `{folder}`: {error.strerror}") from error
    with whole_file(folder / _PAGE) as temporary:
        temporary.write_text(_page(recording.stem, viewer, data), encoding="utf-8", newline="\n")
    if viewer.notices:
        with whole_file(folder / _NOTICES) as temporary:
            temporary.write_text(viewer.notices, encoding="utf-8", newline="\n")
    return folder / _PAGE


def _page(title: str, viewer: ViewerFiles, recording: bytes) -> str:
    parts = {
        "title": escape(title),
        "program": b64encode(gzip.compress(viewer.program, mtime=0)).decode("ascii"),
        "recording": b64encode(recording).decode("ascii"),
        "glue": viewer.glue,
    }
    template = Path(__file__).with_name("page.html").read_text(encoding="utf-8")
    return filled(template, parts)
