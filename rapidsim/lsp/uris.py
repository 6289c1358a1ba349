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
_SCHEME = re.compile(r"[A-Za-z][\w+.-]+:")
"""At least two letters: one would be a drive."""


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
    if _SCHEME.match(path):
        return path
    if not is_windows:
        return f"file://{quote(str(Path(path).absolute()))}"
    absolute = path.replace("\\", "/")
    if absolute.startswith("//"):
        return f"file:{quote(absolute)}"
    return f"file:///{quote(absolute)}"


def is_file(uri: str) -> bool:
    """Whether a URI names a file."""
    return uri[:5].lower() == "file:"


class Uris:
    """The URIs of a client, and the paths of the workspace."""

    def __init__(self) -> None:
        """Know none."""
        self._uri_of: dict[str, str] = {}
        self._path_of: dict[str, str] = {}

    def learn(self, uri: str, path: str) -> None:
        """Keep the spelling of a client for a path of the workspace."""
        self._uri_of[path] = uri
        self._path_of[uri] = path

    def path(self, uri: str) -> str:
        """Return the path of a URI."""
        return self._path_of.get(uri) or path_of(uri)

    def uri(self, path: str) -> str:
        """Return the URI of a path, as the client wrote it if it did."""
        return self._uri_of.get(path) or uri_of(path)
