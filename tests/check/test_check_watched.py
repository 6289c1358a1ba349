"""Watched tasks: a check after a change of a file finds what a check of the same files finds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from rapidsim.jobs.cache.finding_records import Record, StoredFindings, record_of
from rapidsim.jobs.cache.result_cache import sources_of
from rapidsim.jobs.checking.check_files import check_job
from rapidsim.jobs.checking.watched_tasks import WatchedTasks
from rapidsim.jobs.inputs.job import Job, job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.workspace.workspace import Workspace

PROGRAMS = Path(__file__).parents[2] / "programs"
EDITS: tuple[Callable[[str], str], ...] = (
    lambda text: text.replace("ENDPROC", "  nowhere;\n  ENDPROC", 1),
    lambda text: text.replace("v", "VV", 1),
    lambda text: text.replace(";", "", 1),
    lambda text: text.replace("1", "100", 3),
)


def record(of: Job, open_tasks: WatchedTasks | None = None) -> Record:
    """All that a check says, with offsets in the files."""
    found = check_job(of, open_tasks=open_tasks)
    stored = StoredFindings(found.diagnostics, found.coverage, (), lasts=True, arm=found.arm)
    return record_of(stored, sources_of(of))


def edited(before: Job, edit: Callable[[str], str]) -> Job:
    """The job after an edit of the first file of each task."""
    tasks = []
    for task in before.tasks:
        first, *others = task.files
        tasks.append(replace(task, files=(replace(first, text=edit(first.text)), *others)))
    return replace(before, tasks=tuple(tasks))


@pytest.mark.parametrize("reach", [False, True])
@pytest.mark.parametrize("name", ["cell", "multimove", "out_of_reach.mod"])
def test_a_watched_check_finds_what_a_check_finds(name: str, reach: bool) -> None:
    path = PROGRAMS / name
    first = job(RunRequest(paths=(str(path),), reach=reach, trial_run=reach))
    watched = WatchedTasks()
    assert record(first, watched) == record(first)
    for edit in EDITS:
        after = edited(first, edit)
        assert record(after, watched) == record(after)


def test_a_task_is_opened_once(monkeypatch: pytest.MonkeyPatch) -> None:
    opened = []
    open_workspace = Workspace.__init__

    def opens(self: Workspace, *arguments: object, **named: object) -> None:
        opened.append(self)
        open_workspace(self, *arguments, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(Workspace, "__init__", opens)
    first = job(RunRequest(paths=(str(PROGRAMS / "cell"),), reach=False, trial_run=False))
    open_tasks = WatchedTasks()
    for edit in EDITS:
        check_job(edited(first, edit), open_tasks=open_tasks)
    assert len(opened) == len(first.tasks)
