"""A workspace: texts over those on the disk, and findings after changes."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rapidsim.files import SourceFile
from rapidsim.module_files import TaskFiles
from rapidsim.workspace.changes import TextChange
from rapidsim.workspace.workspace import Workspace

MAIN = "MODULE m\n  PROC main()\n    helper;\n  ENDPROC\nENDMODULE\n"
HELPER = "MODULE h\n  PROC helper()\n    WaitDI di1, 1;\n  ENDPROC\nENDMODULE\n"


def workspace(**texts: str) -> Workspace:
    """A workspace of one task; the names of the files end in `.mod`."""
    files = tuple(SourceFile(f"{name}.mod", text, "utf-8") for name, text in texts.items())
    return Workspace([TaskFiles(None, files)])


def codes(of: Workspace, path: str) -> list[str]:
    return [finding.code for finding in of.findings(path)]


def test_findings_follow_a_change() -> None:
    cell = workspace(main=MAIN, helper=HELPER)
    assert codes(cell, "main.mod") == []
    at = MAIN.index("helper") + 1
    changed = cell.change("main.mod", [TextChange(at, at, "x")])
    assert codes(cell, "main.mod") == ["N209"]
    assert "main.mod" in changed.paths
    cell.change("main.mod", [TextChange(at, at + 1, "")])
    assert codes(cell, "main.mod") == []
    assert cell.text("main.mod") == MAIN
    assert cell.version("main.mod") == 2


def test_a_change_changes_findings_of_other_files() -> None:
    cell = workspace(main=MAIN, helper=HELPER)
    at = HELPER.index("helper")
    changed = cell.change("helper.mod", [TextChange(at, at + len("helper"), "other")])
    assert "main.mod" in changed.paths
    assert "N209" in codes(cell, "main.mod")


def test_each_change_refers_to_the_text_that_the_previous_one_left() -> None:
    cell = workspace(main="MODULE m\nENDMODULE\n")
    cell.change("main.mod", [TextChange(8, 8, "12"), TextChange(9, 10, "3")])
    assert cell.text("main.mod") == "MODULE m13\nENDMODULE\n"


def test_a_change_outside_the_text_is_an_error() -> None:
    cell = workspace(main="MODULE m\nENDMODULE\n")
    with pytest.raises(ValueError, match="19 characters"):
        cell.change("main.mod", [TextChange(19, 25, "")])
    assert cell.version("main.mod") == 0


def test_a_closed_file_is_as_on_the_disk() -> None:
    cell = workspace(main=MAIN, helper=HELPER)
    cell.open("main.mod", "MODULE m\nENDMODULE\n")
    assert cell.text("main.mod") == "MODULE m\nENDMODULE\n"
    cell.close("main.mod")
    assert cell.text("main.mod") == MAIN


def test_an_opened_file_of_no_task_is_a_task_of_its_own() -> None:
    cell = workspace(main=MAIN)
    cell.open("other.mod", HELPER)
    assert cell.paths == ("main.mod", "other.mod")
    assert "N209" in codes(cell, "main.mod")
    cell.close("other.mod")
    assert len(cell.paths) == 1


def test_suppressed_findings_are_not_reported() -> None:
    ignored = HELPER.replace("1;", "1; ! rapidsim: ignore[I802]")
    assert "I802" in codes(workspace(h=HELPER), "h.mod")
    assert "I802" not in codes(workspace(h=ignored), "h.mod")
    useless = MAIN.replace("helper;", "RETURN; ! rapidsim: ignore[I802] ignore")
    assert codes(workspace(m=useless), "m.mod") == ["E160"]
    of_reach = MAIN.replace("helper;", "RETURN; ! rapidsim: ignore[K601]")
    assert codes(workspace(m=of_reach), "m.mod") == []


def test_facts_are_known_of_a_broken_program() -> None:
    cell = workspace(main=MAIN.replace("helper;", "helper"), helper=HELPER)
    assert "E1" in codes(cell, "main.mod")[0]
    (call,) = (
        node
        for part in cell.facts("main.mod").routine_parts
        for node in part.calls
        if node.name.text == "helper"
    )
    assert cell.facts("main.mod").routine_called(call) is not None


def test_a_task_keeps_what_is_known_of_it() -> None:
    files = (SourceFile("main.mod", MAIN, "utf-8"),)
    task = replace(TaskFiles("T_ROB1", files), unseen=("helper.mod (encoded)",))
    cell = Workspace([task])
    assert codes(cell, "main.mod") == ["N216"]
    assert cell.task_of("main.mod").name == "T_ROB1"
