"""`rapidsim diff --git`: the older side comes from git, and nothing of a repository is executed."""

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest
from command_line import Ended, call
from test_comparison_mutations import MAIN, POINTS

pytestmark = pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")

SLOWER = MAIN.replace("WaitTime 0.2", "WaitTime 0.5")
SAID = "  argument in pick: WaitTime: 0.2 -> 0.5 (Main.mod:22)\n"


def git(folder: Path, *arguments: str) -> None:
    names = ("-c", "user.name=x", "-c", "user.email=x@example.com", "-c", "commit.gpgsign=false")
    environment = {**os.environ, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
    subprocess.run(
        ["git", *names, *arguments],
        cwd=folder,
        check=True,
        capture_output=True,
        env=environment,
    )


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cell in a repository, with a change that is not committed."""
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    top = tmp_path / "top"
    cell = top / "cells" / "one"
    cell.mkdir(parents=True)
    (cell / "Main.mod").write_text(MAIN)
    (cell / "Points.mod").write_text(POINTS)
    (top / "cells" / "rapidsim.toml").write_text('[robot]\nmodel = "irb1600"\n')
    (top / "large.bin").write_bytes(b"\0" * 1000)
    git(top, "init", "-q", ".")
    git(top, "add", "-A")
    git(top, "commit", "-q", "-m", "one")
    git(top, "tag", "first")
    (cell / "Main.mod").write_text(SLOWER)
    return top


def diff(place: Path, *arguments: str) -> Ended:
    ended = call("diff", "--no-run", *arguments, cwd=place)
    temporary = place
    while not (temporary / "temporary").is_dir():
        temporary = temporary.parent
    assert not list((temporary / "temporary").iterdir())
    return ended


def test_a_whole_commit_id_is_shown_short(repository: Path) -> None:
    head = (repository / ".git" / "refs" / "heads").rglob("*")
    commit = next(file for file in head if file.is_file()).read_text().strip()
    report = json.loads(diff(repository / "cells", "--git", commit, "one", "--format", "json").out)
    assert report["names"] == [f"{commit[:10]}:cells/one", "one"]


@pytest.mark.parametrize(
    ("place", "path"),
    [(".", "cells/one"), ("cells/one", "."), ("cells", "one"), (".", "."), ("cells/one", None)],
)
def test_the_older_side_comes_from_git(place: str, path: str | None, repository: Path) -> None:
    if path == "." and place == ".":
        place, path = "cells", "../cells/one"
    named = () if path is None else (path,)
    ended = diff(repository / place, "--git", "HEAD", *named)
    assert (ended.code, f"Program\n{SAID}" in ended.out) == (1, True), ended.err
    report = json.loads(diff(repository / place, "--git", "first", *named, "--format", "json").out)
    (change,) = report["changes"]
    assert change["old"] == {"file": "first:cells/one/Main.mod", "line": 22}
    assert report["names"][0] == "first:cells/one"
    assert report["configuration"] == []
    git(repository, "commit", "-q", "-a", "-m", "two")
    assert diff(repository / place, "--git", "HEAD", *named).out == "No difference.\n"
    assert SAID in diff(repository / place, "--git", "HEAD~1", *named).out


def test_runs_are_compared_too(repository: Path) -> None:
    ended = call("diff", "--git", "HEAD", "cells/one", cwd=repository)
    assert "pick: WaitTime 0.5 s: not run -> 1.000 s (+1.000 s)" in ended.out


def test_a_file_and_a_station_above_it(repository: Path) -> None:
    file = repository / "cells" / "rapidsim.toml"
    file.write_text('[robot]\nmodel = "irb140"\n')
    ended = diff(repository, "--git", "HEAD", "cells/one/Main.mod")
    assert 'station: `robot`, model: "irb1600" -> "irb140"' in ended.out
    assert SAID in ended.out


def test_a_station_above_the_repository_holds_for_both(repository: Path) -> None:
    (repository / "cells" / "rapidsim.toml").unlink()
    git(repository, "commit", "-q", "-a", "-m", "none")
    (repository.parent / "rapidsim.toml").write_text('[robot]\nmodel = "irb140"\n')
    assert diff(repository, "--git", "HEAD", "cells/one").out == "No difference.\n"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--git", "nowhere", "cells/one"), "has no revision nowhere"),
        (("--git", "--output=x", "cells/one"), "has no revision --output=x"),
        (("--git", "HEAD", "new"), "new is not in revision HEAD"),
        (("--git", "HEAD", "absent"), "absent does not exist"),
        (("--git", "HEAD", "cells", "one"), "--git takes one PATH, not 2"),
        (("cells",), "two paths are compared, not 1"),
        (("--git", "HEAD", ".."), "git cannot read the repository of .."),
    ],
)
def test_what_git_does_not_have_is_said(
    arguments: tuple[str, ...], said: str, repository: Path
) -> None:
    (repository / "new").mkdir()
    (repository / "new" / "Main.mod").write_text(MAIN)
    ended = diff(repository, *arguments)
    assert (ended.code, said in ended.err.replace("\n", " ")) == (2, True), ended.err


def test_a_mistake_in_the_revision_is_told_with_its_name(repository: Path) -> None:
    file = repository / "cells" / "rapidsim.toml"
    file.write_text("[robott]\n")
    git(repository, "commit", "-q", "-a", "-m", "wrong")
    file.write_text("[robot]\n")
    ended = diff(repository, "--git", "HEAD", "cells/one")
    assert (ended.code, "HEAD:cells/rapidsim.toml: robott" in ended.err) == (2, True)


def test_nothing_of_a_repository_is_executed(repository: Path, tmp_path: Path) -> None:
    marker = tmp_path / "executed"
    script = tmp_path / "evil"
    script.write_text(f"#!/bin/sh\ntouch {marker}\ncat\n")
    script.chmod(0o755)
    (repository / ".gitattributes").write_text("*.mod filter=evil diff=evil\n")
    (repository / "secret").write_text("secret")
    (tmp_path / "outside.mod").write_text("MODULE outside\nENDMODULE\n")
    (repository / "cells" / "one" / "Link.mod").symlink_to(tmp_path / "outside.mod")
    git(repository, "add", "-A")
    git(repository, "commit", "-q", "-m", "evil")
    (repository / "cells" / "one" / "Link.mod").unlink()
    hooks = repository / ".git" / "hooks"
    hooks.mkdir(exist_ok=True)
    for name in ("post-checkout", "fsmonitor", "pre-commit", "post-index-change"):
        shutil.copy(script, hooks / name)
    for key in (
        "filter.evil.smudge",
        "filter.evil.clean",
        "filter.evil.process",
        "diff.evil.textconv",
        "diff.external",
        "core.fsmonitor",
        "core.sshCommand",
        "core.pager",
        "core.alternateRefsCommand",
        "alias.ls-tree",
        "credential.helper",
        "gpg.program",
    ):
        git(repository, "config", key, str(script))
    git(repository, "config", "core.hooksPath", str(hooks))
    git(repository, "config", "remote.origin.url", f"ext::{script}")
    git(repository, "config", "remote.origin.promisor", "true")
    git(repository, "config", "protocol.ext.allow", "always")
    git(repository, "config", "extensions.partialClone", "origin")
    marker.unlink(missing_ok=True)
    ended = diff(repository, "--git", "HEAD", "cells/one")
    assert ended.code == 0, ended.err
    assert SAID in diff(repository, "--git", "first", "cells/one").out
    absent = diff(repository, "--git", "0" * 39 + "1", "cells/one")
    assert absent.code == 2
    # A file that the repository promises and does not have is not fetched.
    listed = ["git", "rev-parse", "HEAD:cells/one/Points.mod"]
    found = subprocess.run(listed, cwd=repository, capture_output=True, text=True, check=True)
    name = found.stdout.strip()
    (repository / ".git" / "objects" / name[:2] / name[2:]).unlink()
    assert diff(repository, "--git", "HEAD", "cells/one").code == 2
    assert not marker.exists()


def test_a_working_tree_elsewhere_is_refused(repository: Path, tmp_path: Path) -> None:
    git(repository, "config", "core.worktree", str(tmp_path / "temporary"))
    ended = diff(repository, "--git", "HEAD", "cells/one")
    assert (ended.code, "is not in the working tree" in ended.err.replace("\n", " ")) == (2, True)
