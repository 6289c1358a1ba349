"""A release: its files, and the lines of the workflow that a tag starts."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

from rapidsim import __version__

ROOT = Path(__file__).parents[1]
WORKFLOW = ROOT / ".github" / "workflows" / "release.yml"


@pytest.fixture(scope="module")
def jobs() -> dict[str, Any]:
    found = yaml.safe_load(WORKFLOW.read_text(encoding="utf-8"))
    assert found["permissions"] == {"contents": "read"}
    jobs: dict[str, Any] = found["jobs"]
    return jobs


def test_the_workflow_is_off_and_has_no_more_rights_than_it_needs(jobs: dict[str, Any]) -> None:
    assert set(re.findall(r"vars\.(\w+)", WORKFLOW.read_text(encoding="utf-8"))) == {"RELEASE"}
    assert "RELEASE" in jobs["build"]["if"]
    rights = {name: job.get("permissions") for name, job in jobs.items()}
    assert rights == {
        "build": None,
        "github": {"contents": "write"},
        "pypi": {"id-token": "write"},
    }
    assert (jobs["github"]["needs"], jobs["pypi"]["needs"]) == ("build", "github")
    for job in jobs.values():
        for step in job["steps"]:
            assert ("run" in step) != ("uses" in step)
            assert "${{" not in step.get("run", ""), "an expression there is executed by the shell"


@pytest.mark.process
@pytest.mark.skipif(sys.platform == "win32", reason="the steps are those of Linux")
def test_the_steps_find_version_and_notes(jobs: dict[str, Any], tmp_path: Path) -> None:
    lines = {step["name"]: step["run"] for step in jobs["build"]["steps"] if "run" in step}
    (tmp_path / "rapidsim").symlink_to(ROOT / "rapidsim")
    (tmp_path / "CHANGELOG.md").symlink_to(ROOT / "CHANGELOG.md")

    def code(name: str, tag: str) -> int:
        shell = ["bash", "-e", "-c", lines[name]]
        return subprocess.run(shell, cwd=tmp_path, env={"TAG": tag}, check=False).returncode

    assert code("The tag is the version", f"v{__version__}") == 0
    assert code("The tag is the version", "v9.9.9") == 1
    assert code("Notes", f"v{__version__}") == 0
    notes = (tmp_path / "notes.md").read_text(encoding="utf-8")
    assert 300 < len(notes) < 3_000
    assert "#\n" not in notes
    assert code("Notes", "v9.9.9") == 1


def test_the_version_is_the_same_everywhere() -> None:
    extension = ROOT / "editors" / "vscode"
    package = json.loads((extension / "package.json").read_text(encoding="utf-8"))
    lock = json.loads((extension / "package-lock.json").read_text(encoding="utf-8"))
    assert {package["version"], lock["version"], lock["packages"][""]["version"]} == {__version__}
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    newest = re.findall(r"^## (\S+)(?: \((\d{4}-\d\d-\d\d)\))?$", changes, re.MULTILINE)
    assert newest[0] == ("Unreleased", "")
    assert newest[1][0] == __version__
    assert newest[1][1]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["dynamic"] == ["version"]


@pytest.mark.parametrize("name", ["wish", "wrong_result"])
def test_a_template_is_one_that_github_shows(name: str) -> None:
    text = (ROOT / ".github" / "ISSUE_TEMPLATE" / f"{name}.yml").read_text(encoding="utf-8")
    template = yaml.safe_load(text)
    assert set(template) == {"name", "description", "body"}
    for field in template["body"]:
        assert field["type"] in ("textarea", "input")
        assert field["attributes"]["label"]
    identifiers = [field["id"] for field in template["body"]]
    assert len(identifiers) == len(set(identifiers))


def test_nothing_names_an_owner_to_be_replaced() -> None:
    texts = [
        *(ROOT / "docs").rglob("*.md"),
        *ROOT.glob("*.md"),
        *(ROOT / "containers").iterdir(),
        ROOT / "action.yml",
    ]
    assert not [text for text in texts if re.search(r"\bOWNER\b", text.read_text(encoding="utf-8"))]
