"""File with which a CI service looks at the programs at each change: `rapidsim init --ci`.

It checks them, runs them, keeps the recording as a page, and says in a comment what a change
request changes.
"""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from pathlib import Path

GITHUB, GITLAB = "github", "gitlab"
PLACES = {GITHUB: Path(".github", "workflows", "rapid.yml"), GITLAB: Path(".gitlab-ci.yml")}
IGNORED = ("*.rrd", "*.home/")
"""Files that runs write, as lines of a .gitignore."""

_INSTALL = 'pip install "${RAPIDSIM:?a variable of the project that names what pip installs}"'
"""Not a name: that of the package means another project on the public index."""
_PAGE = "rapidsim view rapidsim.rrd --export rapidsim-page"
_GITHUB = """name: RAPID
on: [push, pull_request]
permissions:
  contents: read
  security-events: write      # findings next to the lines
  pull-requests: write        # what changed, as a comment
env:
  RAPIDSIM: ${{{{ vars.RAPIDSIM }}}}      # what pip installs: docs/ci.md
jobs:
  rapid:
    runs-on: ubuntu-latest
    steps:
      - uses: actions/checkout@v4
        with:
          fetch-depth: 0
      - uses: actions/setup-python@v5
        with:
          python-version: "3.12"
      - run: {install}
      - name: Check
        run: {check}
      - name: Findings beside the lines
        if: success() || failure()
        continue-on-error: true      # a private repository may have no code scanning
        uses: github/codeql-action/upload-sarif@v3
        with:
          sarif_file: rapidsim.sarif
      - name: Run
        if: success() || failure()
        run: {run}
      - name: Recording as a page
        if: (success() || failure()) && hashFiles('rapidsim.rrd') != ''
        run: {page}
      - uses: actions/upload-artifact@v4
        if: success() || failure()
        with:
          name: rapidsim
          path: rapidsim-page
          if-no-files-found: ignore
      - name: What changed
        if: (success() || failure()) && github.event_name == 'pull_request'
        env:
          BASE: ${{{{ github.event.pull_request.base.sha }}}}
        run: {diff}
      - name: What changed, as a comment
        if: (success() || failure()) && github.event_name == 'pull_request'
        continue-on-error: true      # a fork may not comment
        env:
          GH_TOKEN: ${{{{ github.token }}}}
        run: >-
          gh pr comment "${{{{ github.event.number }}}}" --edit-last --create-if-none
          --body-file rapidsim-diff.md
"""
_GITLAB = """rapid:
  image: python:3.12
  rules:
    - if: $CI_PIPELINE_SOURCE == "merge_request_event"
    - if: $CI_COMMIT_BRANCH == $CI_DEFAULT_BRANCH
  variables:
    GIT_DEPTH: 0
  before_script:
    - {install}
  script:
    - {check}
    - {run}
  after_script:
    - "test ! -f rapidsim.rrd || {page_text}"
    - |
      if [ -n "$CI_MERGE_REQUEST_DIFF_BASE_SHA" ]; then
        export BASE="$CI_MERGE_REQUEST_DIFF_BASE_SHA"
        {diff_text}
        # A comment needs a token with the scope `api`, as a masked variable of the project.
        if [ -n "$RAPIDSIM_TOKEN" ]; then
          request="$CI_API_V4_URL/projects/$CI_PROJECT_ID/merge_requests/$CI_MERGE_REQUEST_IID"
          curl --fail --header "PRIVATE-TOKEN: $RAPIDSIM_TOKEN" \\
            --data-urlencode "body@rapidsim-diff.md" "$request/notes"
        fi
      fi
  artifacts:
    when: always
    paths:
      - rapidsim-page
      - rapidsim-diff.md
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
        paths: Paths to check, run and compare, from the top of the repository.
    """
    safe = [f"./{path}" if path.startswith("-") else path for path in paths]
    named = shlex.join(safe)
    kind, to = ("sarif", "rapidsim.sarif") if service == GITHUB else ("junit", "rapidsim.xml")
    comparisons = (
        f'rapidsim diff --git "$BASE" {shlex.quote(path)} --format markdown || test $? -eq 1'
        for path in safe
    )
    diff = f"{{ {'; '.join(comparisons)}; }} > rapidsim-diff.md"
    commands = {
        "check": f"rapidsim check {named} --format {kind} > {to}",
        "run": f"rapidsim run {named} --record rapidsim.rrd",
        "page": _PAGE,
        "diff": diff,
    }
    # A JSON string is a YAML string, whatever characters the names contain.
    quoted = {step: json.dumps(command) for step, command in commands.items()}
    text = _GITHUB if service == GITHUB else _GITLAB
    return text.format(**quoted, install=json.dumps(_INSTALL), page_text=_PAGE, diff_text=diff)


def ignored_lines(repository: Path) -> tuple[str, ...]:
    """Return the lines that its .gitignore lacks."""
    file = repository / ".gitignore"
    try:
        known = file.read_text(encoding="utf-8", errors="replace").split() if file.is_file() else []
    except OSError:
        known = []
    return tuple(line for line in IGNORED if line not in known)
