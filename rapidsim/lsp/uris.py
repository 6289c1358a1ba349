"""URIs of documents, and paths of files.

A file that an editor opened keeps the URI that the editor wrote: clients spell the same path in
several ways (`file:///c%3A/a.mod`, `file:///C:/a.mod`) and compare them as texts. A document that
is no file, such as `untitled:Untitled-1`, has its URI as path.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from urllib.parse import quote, unquote, urlsplit

_DRIVE = re.compile(r"/([A-Za-z]):(?=/|$)")


def path_of(uri: str, *, is_windows: bool = os.name == "nt") -> str:
    """Return the path of a file URI; any other URI is returned as it is."""
    try:
        parts = urlsplit(uri)
    except ValueError:
        return uri
    if parts.scheme.lower() != "file":
        return uri
    path = unquote(parts.path)
    if not is_windows:
        return path
    if drive := _DRIVE.match(path):
        path = f"{drive[1].upper()}:{path[drive.end() :]}"
    elif parts.netloc:
        path = f"//{parts.netloc}{path}"
    return path.replace("/", "\\")


def uri_of(path: str, *, is_windows: bool = os.name == "nt") -> str:
    """Return the URI of a path; a path that is a URI is returned as it is."""
    if re.match(r"[A-Za-z][\w+.-]+:", path):
        return path
    absolute = path if is_windows else str(Path(path).absolute())
    absolute = absolute.replace("\\", "/") if is_windows else absolute
    if is_windows and absolute.startswith("//"):
        return f"file:{quote(absolute)}"
    return f"file://{'/' if is_windows else ''}{quote(absolute)}"


class Uris:
    """The URIs of a client, by path."""

    def __init__(self) -> None:
        """Know none."""
        self._of_client: dict[str, str] = {}

    def path(self, uri: str) -> str:
        """Return the path that a client means, and keep the spelling of its URI."""
        path = path_of(uri)
        self._of_client[path] = uri
        return path

    def uri(self, path: str) -> str:
        """Return the URI of a path, as the client wrote it if it did."""
        return self._of_client.get(path) or uri_of(path)
