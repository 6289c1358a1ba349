"""What happens to the signals and devices of a station, and when."""

from __future__ import annotations

from pathlib import Path

import pytest
from station_files import station

from rapidsim.controller.cell.conditions import read_condition
from rapidsim.controller.cell.faults import Channel, FailureKind
from rapidsim.diagnostics import Severity
from rapidsim.files import InputError
from rapidsim.station.check import find_project_settings


def test_stimuli_faults_and_connections_have_their_times(tmp_path: Path) -> None:
    text = """[[cross]]
set = "doLamp"
from = "doRun and not diFault"
after = 0.4
[[cross]]
set = "doHorn"
from = "diFault"
[[stimulus]]
when = "doGrip = 1"
after = 0.4
set = { diGripped = 1, aiForce = 2.5, diOpen = false }
pulse = 2.0
skip = [2, 3]
[[stimulus]]
at = 1
every = 0.5
set = { diPart = 1 }
nth = [1]
[[fault]]
kind = "emergency_stop"
at = 2.0
for = 3.0
[[fault]]
kind = "delay"
every = 5
by = 0.25
on = "egm"
count = 3
[[fault]]
kind = "elog"
when = "diFault"
code = 40123
severity = "warning"
title = "Odd"
texts = ["a", "b"]
"""
    io = station(text, tmp_path).io
    lamp, horn = io.crosses
    assert (lamp.result, lamp.after_s) == ("doLamp", 0.4)
    assert lamp.condition == read_condition("doRun and not diFault")
    assert (horn.result, horn.after_s) == ("doHorn", 0.0)
    gripped, part = io.stimuli
    assert gripped.when == read_condition("doGrip = 1")
    assert (gripped.after_s, gripped.pulse_s, gripped.skip, gripped.nth) == (0.4, 2.0, (2, 3), ())
    assert gripped.values == {"diGripped": 1.0, "aiForce": 2.5, "diOpen": 0.0}
    assert (part.at_s, part.every_s, part.nth, part.pulse_s) == (1.0, 0.5, (1,), None)
    stop, delay, entry = io.faults
    assert (stop.kind, stop.at_s, stop.for_s) == (FailureKind.EMERGENCY_STOP, 2.0, 3.0)
    assert (delay.every_s, delay.by_s, delay.on, delay.count) == (5.0, 0.25, Channel.EGM, 3)
    assert entry.when == read_condition("diFault")
    assert (entry.code, entry.severity, entry.title) == (40123, "warning", "Odd")
    assert entry.texts == ("a", "b")


def test_grippers_belts_and_fingers(tmp_path: Path) -> None:
    text = """[gripper]
close = "doGrip = 1"
closed = "diGripped = 1"
at = "anywhere"
load = 2.5
task = "T_ROB1"
[[smart_gripper]]
object = 12
[[conveyor]]
unit = "CNV1"
speed = 200
at = 1
every = 2
length = 1500
maximum = 900
runs = "doBelt"
switch = "diSync"
connected = "diOn"
position = [1, 2, 3]
[check]
select = ["T"]
extend-select = ["I"]
ignore = ["T309"]
fail-on = "error"
cycle-budget = 12
assume-missing = true
[check.per-file-ignores]
"*Data.mod" = ["I1", "I2"]
"""
    found = station(text, tmp_path)
    (gripper,) = found.io.grippers
    assert (gripper.name, gripper.at, gripper.load_kg) == ("the gripper", "anywhere", 2.5)
    assert (gripper.closed, gripper.task) == (read_condition("diGripped = 1"), "T_ROB1")
    (fingers,) = found.io.smart_grippers
    assert (fingers.task, fingers.object_mm) == (None, 12.0)
    (belt,) = found.io.conveyors
    assert (belt.unit, belt.speed_mm_s, belt.first_s, belt.every_s) == ("CNV1", 200.0, 1.0, 2.0)
    assert (belt.length_mm, belt.most_mm, belt.has_place) == (1500.0, 900.0, True)
    assert (belt.runs, belt.switch, belt.connected) == (read_condition("doBelt"), "diSync", "diOn")
    check = found.check
    assert (check.select, check.extend_select, check.ignore) == (("T",), ("I",), ("T309",))
    assert (check.fail_on, check.fails_from) == (Severity.ERROR, Severity.ERROR)
    assert (check.cycle_budget_s, check.assume_missing, check.strict) == (12.0, True, False)
    assert check.per_file_ignores == (("*Data.mod", ("I1", "I2")),)
    assert station("", tmp_path).check.fails_from is Severity.WARNING
    two = '[[gripper]]\nclose = "a"\nname = "left"\n[[gripper]]\nclose = "b"\n'
    assert [one.name for one in station(two, tmp_path).io.grippers] == ["left", "the gripper"]


def test_settings_of_a_check_are_those_of_the_nearest_project(tmp_path: Path) -> None:
    inner = tmp_path / "cell" / "modules"
    inner.mkdir(parents=True)
    file = inner / "a.mod"
    file.write_text("")
    top, near = tmp_path / "pyproject.toml", tmp_path / "cell" / "pyproject.toml"
    top.write_text('[tool.rapidsim.check]\nselect = ["T"]\n')
    near.write_text('[project]\nname = "rapidsim of mine"\n')
    found = find_project_settings(["-", str(tmp_path / "none.mod"), str(file)])
    assert found is not None
    assert (found.select, found.file) == (("T",), top)
    near.write_text('[tool.rapidsim.check]\nselect = ["I"]\n')
    found = find_project_settings([str(inner)])
    assert found is not None
    assert (found.select, found.file) == (("I",), near)
    assert find_project_settings(["-"]) is None
    near.write_text('[tool.rapidsim.check]\nselected = ["I"]\n')
    with pytest.raises(InputError, match=r"tool\.rapidsim\.check\.selected: no such key"):
        find_project_settings([str(file)])
