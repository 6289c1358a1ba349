"""Drafts of station files, as text; what is no comment in them is read again."""

from __future__ import annotations

from pathlib import Path

from station_files import station

from rapidsim.controller.cell.description import SignalDeclaration, SignalKind, Status
from rapidsim.station.backup.cfg_file import configuration_text, read_configuration
from rapidsim.station.backup.robots import arm_type
from rapidsim.station.ci_file import GITHUB, GITLAB, ci_text, ignored_lines, repository_of
from rapidsim.station.task_kind import TaskKind
from rapidsim.station.template import (
    StationTemplate,
    SuggestedStimulus,
    Suggestions,
    TemplateRobot,
    TemplateTask,
    draft_text,
)

DRAFT = StationTemplate(
    remarks=("From a backup.",),
    robots=(
        TemplateRobot("left", "irb120"),
        TemplateRobot("right"),
    ),
    tasks=(
        TemplateTask("T_ROB1", ("a.mod", "prüfen.mod"), robot="left"),
        TemplateTask(
            "T_BACK", ("b.mod",), TaskKind.STATIC, moves=False, entry="watch", refers_late=True
        ),
    ),
    signals=(
        SignalDeclaration("diA", SignalKind.DI, 1.0, 0.0, 1.0),
        SignalDeclaration("go B", SignalKind.GO, 0.0, 0.0, 15.0),
        SignalDeclaration("aoC", SignalKind.AO, 2.5, -10.0, None),
        SignalDeclaration("doD", SignalKind.DO, 1.0, 0.0, 1.0, Status.CYCLE_ON, "T_ROB1", "ROB_2"),
        SignalDeclaration("doE", SignalKind.DO, 0.0, 0.0, 1.0, Status.CYCLE_ON),
    ),
    missing=("tGrip (a tool)", "helper (a procedure)"),
    suggestions=Suggestions(
        arm="targets of six axes",
        signals=(SignalDeclaration("diF", SignalKind.DI, 0.0, 0.0, 1.0),),
        missing=("wOther",),
        stimuli=(SuggestedStimulus("diA", 1.0), SuggestedStimulus("diF", 0.0, "doD = 1")),
        undriven=("diG", "di H"),
        objects=True,
    ),
)
TEXT = """# From a backup.

[[robot]]
name = "left"
model = "irb120"

[[robot]]
name = "right"
# model = "..."   # no arm is named: `rapidsim robots` lists those available

[[task]]
name = "T_ROB1"
modules = ["a.mod", "prüfen.mod"]
robot = "left"

[[task]]
name = "T_BACK"
modules = ["b.mod"]
type = "static"
entry = "watch"
check_references = false
motion = false

[signals]
diA = { type = "di", value = 1 }
"go B" = { type = "go", width = 4 }
aoC = { type = "ao", value = 2.5, min = -10 }
doD = { type = "do", system = "CycleOn", task = "T_ROB1", unit = "ROB_2" }
doE = { type = "do", system = "CycleOn" }

[check]
# These names are declared nowhere here. Calls of them are skipped, tools are tool0, and
# the headline of each run counts it. Delete this when the modules are here:
# tGrip (a tool), helper (a procedure)
assume-missing = true

# The arm: targets of six axes.
# [robot]
# model = "..."

# Used by the programs, and not declared in EIO.cfg:
# [signals]
# diF = { type = "di" }

# [check]
# These names are declared nowhere here. Calls of them are skipped, tools are tool0, and
# the headline of each run counts it. Delete this when the modules are here:
# wOther
# assume-missing = true

# Inputs that a program waits for and nothing sets; what does, and when?

# [[stimulus]]
# at = 2.0
# set = { diA = 1 }

# [[stimulus]]
# when = "doD = 1"
# after = 0.4
# set = { diF = 0 }

# Other inputs that nothing sets: diG, di H

# Bodies that the arm must not touch; sizes and positions in mm:
# [[object]]
# name = "table"
# box = [800, 600, 40]
# pose = { position = [900, 0, -20] }
"""


def test_a_draft_says_all_that_is_known_and_what_may_be_wanted(tmp_path: Path) -> None:
    assert draft_text(DRAFT) == TEXT
    read = station(TEXT, tmp_path)
    assert [robot.name for robot in read.robots] == ["irb120", None]
    assert [(task.name, task.kind) for task in read.tasks] == [
        ("T_ROB1", TaskKind.NORMAL),
        ("T_BACK", TaskKind.STATIC),
    ]
    assert [one.name for one in read.io.signals] == [one.name for one in DRAFT.signals]


def test_a_draft_of_one_arm_has_no_list_and_a_pulse_where_nothing_is_waited_for() -> None:
    draft = StationTemplate(
        robots=(TemplateRobot("left", "irb120"),),
        suggestions=Suggestions(undriven=("di H",)),
    )
    assert draft_text(draft) == (
        '[robot]\nmodel = "irb120"\n\n'
        "# Other inputs that nothing sets: di H\n\n"
        '# [[stimulus]]\n# at = 1.0\n# pulse = 0.5\n# set = { "di H" = 1 }\n'
    )


def test_a_service_checks_runs_and_compares_the_paths(tmp_path: Path) -> None:
    text = ci_text(GITHUB, ["cell one", "-b"])
    assert "run: \"rapidsim check 'cell one' ./-b --format sarif > rapidsim.sarif\"" in text
    assert "run: \"rapidsim run 'cell one' ./-b --record rapidsim.rrd\"" in text
    assert (
        "rapidsim diff --git \\\"$BASE\\\" 'cell one' --format markdown || test $? -eq 1;" in text
    )
    assert " ./-b --format markdown || test $? -eq 1; } > rapidsim-diff.md" in text
    assert "${{ vars.RAPIDSIM }}" in text
    text = ci_text(GITLAB, ["a.mod"])
    assert '- "rapidsim check a.mod --format junit > rapidsim.xml"' in text
    assert "${RAPIDSIM:?a variable" in text
    inner = tmp_path / "a" / "b"
    inner.mkdir(parents=True)
    assert repository_of(inner) != tmp_path
    (tmp_path / ".git").mkdir()
    assert repository_of(inner) == tmp_path
    assert ignored_lines(tmp_path) == ("*.rrd", "*.home/")
    (tmp_path / ".gitignore").write_text("*.rrd\nbuild\n")
    assert ignored_lines(tmp_path) == ("*.home/",)


def test_configuration_is_written_as_it_is_read() -> None:
    types = {
        "EIO_SIGNAL": ({"Name": "di1", "SignalType": "DI"}, {"Name": "do1", "Label": "a b"}),
        "EIO_CROSS": ({"Name": "c", "Act1_invert": "true"},),
    }
    text = configuration_text("EIO", types)
    assert text.startswith("EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n")
    assert read_configuration(text) == {
        name: [dict(one) for one in instances] for name, instances in types.items()
    }


def test_the_type_of_an_arm_means_the_arm_of_the_catalogue() -> None:
    assert arm_type("irb120-3-0.58") == "ROB1_120_0.58_3"
    assert arm_type("crb15000-5-0.95") == "ROB1_CRB_15000_0.95_5"
    assert arm_type("irb14000-0.5-0.5-left") == "ROB1_L_14000_0.5_0.5"
    assert arm_type("kr10-r900-2") == "kr10-r900-2"
