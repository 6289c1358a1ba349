"""File with which a CI service checks the programs at each change: `rapidsim init --ci`."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from pathlib import Path

GITHUB, GITLAB = "github", "gitlab"
PLACES = {GITHUB: Path(".github", "workflows", "rapid.yml"), GITLAB: Path(".gitlab-ci.yml")}
IGNORED = ("*.rrd", "*.home/")
"""Files that runs write, as lines of a .gitignore."""

_INSTALL = "pip install git+https://github.com/OWNER/rapidsim"
_GITHUB = """name: RAPID
on: [push, pull_request]
jobs:
  check:
    runs-on: ubuntu-latest
    steps:
      - uses: actions/checkout@v4
      - uses: actions/setup-python@v5
        with:
          python-version: "3.12"
      - run: {install}      # where you have it from
      - run: {check}
      - run: {run}
"""
_GITLAB = """rapid:
  image: python:3.12
  script:
    - {install}      # where you have it from
    - {check}
    - {run}
  artifacts:
    when: always
    reports:
      junit: rapidsim.xml
"""


def repository_of(folder: Path) -> Path | None:
    """Return the top folder of the repository of a folder; None if it is in no repository."""
    return next((one for one in (folder, *folder.parents) if (one / ".git").exists()), None)


def ci_text(service: str, paths: Sequence[str]) -> str:
    """Return the text of the file.

    Args:
        service: `github` or `gitlab`.
        paths: Paths to check and run, from the top of the repository.
    """
    named = shlex.join(f"./{path}" if path.startswith("-") else path for path in paths)
    kind = "github" if service == GITHUB else "junit"
    to = "" if service == GITHUB else " > rapidsim.xml"
    # A JSON string is a YAML string, whatever characters the names contain.
    check = json.dumps(f"rapidsim check {named} --output-format {kind}{to}")
    run = json.dumps(f"rapidsim run {named} --no-record")
    text = _GITHUB if service == GITHUB else _GITLAB
    return text.format(install=_INSTALL, check=check, run=run)


def ignored_lines(repository: Path) -> tuple[str, ...]:
    """Return the lines that its .gitignore lacks."""
    file = repository / ".gitignore"
    try:
        known = file.read_text(encoding="utf-8", errors="replace").split() if file.is_file() else []
    except OSError:
        known = []
    return tuple(line for line in IGNORED if line not in known)
