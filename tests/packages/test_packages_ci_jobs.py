"""The jobs that `rapidsim init --ci` writes: their shell lines, in a repository with a change."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml
from command_line import call

pytestmark = pytest.mark.packages
PROGRAM = """MODULE Swing
  PROC main()
    MoveAbsJ [[30,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
  ENDPROC
ENDMODULE
"""


def git(folder: Path, *arguments: str) -> str:
    as_somebody = ("-c", "user.name=A", "-c", "user.email=a@example.org")
    command = ["git", *as_somebody, *arguments]
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A cell whose newest version is slower."""
    folder = tmp_path / "my cell"
    folder.mkdir()
    (folder / "rapidsim.toml").write_text('[robot]\nmodel = "irb1600-6-1.2"\n')
    (folder / "Swing.mod").write_text(PROGRAM)
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-qm", "first")
    (folder / "Swing.mod").write_text(PROGRAM.replace("v1000", "v200"))
    return tmp_path


def ran(lines: list[str], folder: Path, **variables: str) -> None:
    """Run lines as a job does: one after the other, until one fails."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    script = "\n".join(line for line in lines if "pip install" not in line)
    subprocess.run(
        ["bash", "-e", "-c", script],
        cwd=folder,
        env={**os.environ, "PATH": path, **variables},
        check=True,
    )


def results(folder: Path) -> str:
    """What both jobs leave: a page, and what the change changes."""
    assert (folder / "rapidsim-page" / "index.html").stat().st_size > 10_000_000
    return (folder / "rapidsim-diff.md").read_text()


def test_the_job_for_github(repository: Path) -> None:
    assert call("init", "my cell", "--ci", "github", cwd=repository).code == 0
    job = yaml.safe_load((repository / ".github" / "workflows" / "rapid.yml").read_text())
    lines = [step.get("run", "") for step in job["jobs"]["rapid"]["steps"]]
    (comment,) = (line for line in lines if line.startswith("gh "))
    assert comment.endswith("--body-file rapidsim-diff.md")
    base = git(repository, "rev-parse", "HEAD").strip()
    ran([line for line in lines if line != comment], repository, BASE=base)
    found = json.loads((repository / "rapidsim.sarif").read_text())
    assert found["runs"][0]["tool"]["driver"]["name"] == "rapidsim"
    assert "v1000 -> v200" in results(repository)


def test_the_job_for_gitlab(repository: Path) -> None:
    assert call("init", "my cell", "--ci", "gitlab", cwd=repository).code == 0
    job = yaml.safe_load((repository / ".gitlab-ci.yml").read_text())["rapid"]
    base = git(repository, "rev-parse", "HEAD").strip()
    ran(
        [*job["before_script"], *job["script"], *job["after_script"]],
        repository,
        CI_MERGE_REQUEST_DIFF_BASE_SHA=base,
        RAPIDSIM_TOKEN="",
    )
    assert ElementTree.parse(repository / "rapidsim.xml").getroot().tag == "testsuites"
    assert "v1000 -> v200" in results(repository)
