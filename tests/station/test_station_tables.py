"""What the tables of a station file become."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import numpy as np
import pytest
from station_files import AXIS, station

from rapidsim.collisions.geometry import IgnoredPair, Parent, ParentKind
from rapidsim.controller.cell.description import SignalDeclaration, SignalKind, Status
from rapidsim.files import InputError
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import load_robot
from rapidsim.station.read import NO_BACKUP, read_io
from rapidsim.station.robot import StationRobot
from rapidsim.station.task_kind import TaskEvent, TaskKind
from rapidsim.station.tasks import StationTask
from rapidsim.station.units import LengthUnit


def test_what_no_table_names_has_its_default(tmp_path: Path) -> None:
    found = station("", tmp_path)
    assert (found.robots, found.external_axes, found.geometry) == ((), (), None)
    assert [task.name for task in found.tasks] == []
    assert found.starts_at is None
    text = '[[robot]]\nmodel = "irb120"\n[[task]]\n[[task]]\nname = "B"\ntype = "static"\n'
    found = station(text, tmp_path)
    first, second = found.tasks
    assert (first.name, first.kind, first.robot_number) == ("T_ROB1", TaskKind.NORMAL, 0)
    assert (second.name, second.kind, second.robot_number) == ("B", TaskKind.STATIC, None)
    assert first.refers_late is False


def test_robots_and_tasks_belong_together(tmp_path: Path) -> None:
    text = """[[robot]]
name = "left"
model = "irb120"
base = { position = [1000, 0, 500], quaternion = [0, 0, 0, 1] }
start = [0, 1, 2, 3, 4, 5]
[[robot]]
name = "right"
urdf = "arm.urdf"
scale = 0.001
[[robot]]
model = "irb1600"
[[task]]
name = "A"
modules = ["a.mod", "b"]
robot = "RIGHT"
entry = "go"
check_references = false
events = { START = "begin", STOP = "halt" }
rmq = { size = 400, messages = 7 }
[[task]]
name = "B"
[[task]]
name = "C"
motion = false
[[task]]
name = "D"
type = "semistatic"
motion = true
"""
    found = station(text, tmp_path)
    left, right, third = found.robots
    assert left.world_from_base.translation == pytest.approx([1.0, 0.0, 0.5])
    assert left.world_from_base.rotation == pytest.approx(np.diag([-1.0, -1.0, 1.0]))
    assert left.start_joints_deg == (0, 1, 2, 3, 4, 5)
    assert (right.name, right.scale) == (str(tmp_path / "arm.urdf"), 0.001)
    assert third.label is None
    a, b, c, d = found.tasks
    assert [one.robot_number for one in (a, b, c, d)] == [1, 0, None, 2]
    assert a.modules == (tmp_path / "a.mod", tmp_path / "b")
    assert (a.entry, a.refers_late) == ("go", True)
    assert a.events == ((TaskEvent.START, "begin"), (TaskEvent.STOP, "halt"))
    assert a.queue is not None
    assert b.queue is None
    assert (a.queue.max_bytes, a.queue.max_messages) == (400, 7)


def test_a_file_goes_before_a_backup_key_by_key(tmp_path: Path) -> None:
    axis = ExternalAxis(
        "STN1", "a", False, -1.0, 1.0, 2.0, 4.0, direction=(1.0, 0.0, 0.0), carries="wobj"
    )
    track = replace(axis, unit="TRACK", letter="b", linear=True)
    backup = replace(
        NO_BACKUP,
        robots=(
            StationRobot("irb120", label="one", bounds=((-1.0, 1.0),) * 6),
            StationRobot("irb1600", label="two"),
        ),
        external_axes=(track, axis),
        tasks=(StationTask("A", entry="go", refers_late=True), StationTask("B", robot_number=1)),
        io=replace(
            NO_BACKUP.io,
            signals=(
                SignalDeclaration("di1", SignalKind.DI, 1.0, 0.0, 1.0),
                SignalDeclaration("ao1", SignalKind.AO, 2.0, 0.0, 10.0),
                SignalDeclaration("do1", SignalKind.DO, 0.0, 0.0, 1.0),
            ),
        ),
    )
    text = """[[robot]]
name = "TWO"
start = [1, 2, 3, 4, 5, 6]
[[external_axis]]
name = "stn1"
speed = 90
[[task]]
name = "a"
type = "static"
[[task]]
name = "C"
motion = false
[signals]
AO1 = { max = 5 }
do1 = { type = "di" }
"""
    found = station(text, tmp_path, backup)
    assert [(one.name, one.label) for one in found.robots] == [
        ("irb120", "one"),
        ("irb1600", "TWO"),
    ]
    assert found.robots[0].bounds == ((-1.0, 1.0),) * 6
    assert found.robots[1].start_joints_deg == (1, 2, 3, 4, 5, 6)
    first, second = found.external_axes
    assert second is track
    assert (first.unit, first.letter, first.carries) == ("stn1", "a", "wobj")
    assert first.max_speed == pytest.approx(math.radians(90.0))
    assert (first.lower, first.upper) == pytest.approx((-1.0, 1.0))
    assert first.max_acceleration == pytest.approx(4.0)
    a, b, c = found.tasks
    assert (a.name, a.entry, a.refers_late, a.kind) == ("a", "go", True, TaskKind.STATIC)
    assert (b.robot_number, c.name) == (1, "C")
    signals = {one.name: one for one in found.io.signals}
    assert list(signals) == ["di1", "AO1", "do1"]
    assert (signals["AO1"].value, signals["AO1"].lowest, signals["AO1"].highest) == (2.0, 0.0, 5.0)
    assert signals["do1"].kind is SignalKind.DI
    other = station('[[robot]]\nmodel = "irb140"\n', tmp_path, backup)
    assert other.robots[0].bounds == ()
    assert other.remarks == ("joint limits of the backup are those of irb120, not of irb140",)


def test_axes_are_in_metres_and_radians_in_the_order_of_their_letters(tmp_path: Path) -> None:
    text = (
        AXIS
        + 'start = 10\ncarries = "wobj"\nframe = { position = [100, 0, 0] }\n'
        + '[[external_axis]]\nname = "TRACK"\naxis = "a"\nkind = "linear"\nlimits = [0, 2000]\n'
        + "speed = 1000\nacceleration = 2500\n[motion]\nacceleration_time = 0.5\n"
    )
    track, table = station(text, tmp_path).external_axes
    assert (track.letter, track.linear, track.carries) == ("a", True, None)
    assert (track.lower, track.upper, track.max_speed) == (0.0, 2.0, 1.0)
    assert track.max_acceleration == pytest.approx(2.5)
    assert track.direction == (1.0, 0.0, 0.0)
    assert (table.letter, table.linear, table.carries) == ("b", False, "wobj")
    assert (table.lower, table.upper) == pytest.approx((-math.pi / 2, math.pi))
    assert table.max_speed == pytest.approx(math.pi / 4)
    assert table.max_acceleration == pytest.approx(math.pi / 2)
    assert table.start == pytest.approx(math.radians(10.0))
    assert table.direction == (0.0, 0.0, 1.0)
    assert table.world_from_user.translation == pytest.approx([0.1, 0.0, 0.0])


def test_a_model_is_its_version_with_what_the_file_changes(tmp_path: Path) -> None:
    plain = station("", tmp_path)
    assert plain.model.own_accelerations
    assert (plain.nearest_configuration, plain.exact_configuration) == (False, False)
    text = """[motion]
acceleration = [90, 180]
axis_speed = [45]
filter_time = 0
zone_share = 1
configuration = "stop"
[dynamics]
torque = [1, 2, 3]
"""
    found = station(text, tmp_path)
    assert found.model.acceleration == pytest.approx((math.pi / 2, math.pi))
    assert found.model.max_speed == pytest.approx((math.pi / 4,))
    assert (found.model.filter_time, found.model.zone_share) == (0.0, 1.0)
    assert found.model.torque == (1.0, 2.0, 3.0)
    assert (found.nearest_configuration, found.exact_configuration) == (False, True)
    assert station('[motion]\nconfiguration = "nearest"', tmp_path).nearest_configuration
    timed = station("[motion]\nacceleration_time = 0.2", tmp_path).model
    assert (timed.acceleration_time, timed.own_accelerations) == (0.2, False)
    zones = '[motion]\norientation_zone = "programmed"\n'
    ignored = station(zones, tmp_path)
    assert len(ignored.remarks) == 1
    assert ignored.model.orientation_zone == plain.model.orientation_zone
    old = station(zones + 'model = "1"\n', tmp_path)
    assert (old.remarks, old.model.orientation_zone) == ((), "programmed")


def test_signals_have_the_limits_of_their_kind(tmp_path: Path) -> None:
    text = """[signals]
a = { type = "DI", value = true }
b = { type = "go", width = 8, value = 255 }
c = { type = "ai", min = -5, value = -5 }
d = { type = "do", system = "MotorOn", unit = "ROB_2" }
e = { type = "gi" }
"""
    a, b, c, d, e = station(text, tmp_path).io.signals
    assert [one.value for one in (a, b, c)] == [1.0, 255.0, -5.0]
    limits = [(one.lowest, one.highest) for one in (a, b, c, e)]
    assert limits[:3] == [(0.0, 1.0), (0.0, 255.0), (-5.0, None)]
    assert limits[3][0] == 0.0
    assert d.status is not None
    assert (d.kind, d.unit, d.value) == (SignalKind.DO, "ROB_2", d.status.at_start)
    assert isinstance(d.status, Status)


def test_peers_cameras_and_parts(tmp_path: Path) -> None:
    text = """[[socket]]
accept = "127.0.0.1:65535"
repeat = true
steps = [{ expect = "A", after = 0.2, send = "ä" }]
[[socket]]
connect = 1
after = 2
reconnect = true
[[camera]]
name = "cam"
after = 0.3
parameters = { "A.B" = 7, c = true, d = "x" }
pictures = [[], [{ name = "p", position = [1, 2, 3], val2 = 5, string1 = "s", type = 4 }]]
[[search]]
wobj = "w"
position = [1, 2, 3]
[clock]
start = 2025-03-01T06:00:00Z
"""
    found = station(text, tmp_path)
    server, client = found.io.sockets
    assert (server.address, server.port, server.serves, server.repeats) == (
        *("127.0.0.1", 65535, True, True),
    )
    assert (server.steps[0].send, server.steps[0].after_s) == (b"\xe4", 0.2)
    assert (client.port, client.serves, client.after_s, client.reconnects) == (1, False, 2.0, True)
    (camera,) = found.io.cameras
    assert (camera.after_s, camera.repeats) == (0.3, False)
    assert camera.parameters == (("a.b", 7.0), ("c", True), ("d", "x"))
    assert camera.pictures[0] == ()
    (target,) = camera.pictures[1]
    assert (target.name, target.val2, target.string1, target.type) == ("p", 5.0, "s", 4.0)
    assert tuple(target.cframe.trans) == (1.0, 2.0, 3.0)
    assert (target.cameraname, target.sceneid) == ("cam", 2.0)
    (part,) = found.io.parts
    assert tuple(part.pose.trans) == (1.0, 2.0, 3.0)
    assert (part.wobj, part.search) == ("w", None)
    assert found.starts_at == datetime(2025, 3, 1, 6)


def test_bodies_have_their_size_and_their_frame(tmp_path: Path) -> None:
    text = """[[object]]
name = "box"
box = [100, 200, 300]
pose = { position = [900, 0, -20] }
colour = "#6080A0"
[[object]]
name = "ball"
sphere = { diameter = 50 }
parent = "wobj:wobjVice"
[[object]]
name = "pin"
cylinder = { diameter = 20, length = 80 }
parent = "link:3"
robot = "left"
[[object]]
name = "rod"
capsule = { diameter = 20, length = 80 }
parent = "unit:STN1:2"
[[object]]
name = "floor"
plane = true
parent = "unit:STN2"
[[attach]]
when = "doGrip = 1"
object = "B*"
to = "tool:pin"
nearest = 5
robot = "left"
[[source]]
object = "ball"
every = 2
[[source]]
object = "box"
when = "diMore"
[[sink]]
on = "floor"
after = 3
holds = 10000
[collisions]
clearance = 12
stop-on-collision = true
own-links = false
ignore = [{ between = ["box", "link 3"], reason = "on purpose" }]
"""
    cell = station(text, tmp_path).geometry
    assert cell is not None
    box, ball, pin, rod, floor = cell.objects
    sizes = [np.ptp(one.shape.vertices, axis=0) for one in (box, ball, pin, rod)]
    assert sizes[0] == pytest.approx([0.1, 0.2, 0.3])
    for size, wanted in zip(
        sizes[1:], ([0.05] * 3, [0.02, 0.02, 0.08], [0.02, 0.02, 0.08]), strict=True
    ):
        assert size == pytest.approx(wanted, rel=0.02)
    assert box.parent_from_object.translation == pytest.approx([0.9, 0.0, -0.02])
    assert box.colour == (0x60, 0x80, 0xA0)
    assert box.parent == Parent(ParentKind.WORLD)
    assert ball.parent == Parent(ParentKind.WOBJ, name="wobjVice")
    assert pin.parent == Parent(ParentKind.LINK, link=3, robot="left")
    assert rod.parent == Parent(ParentKind.UNIT, name="STN1", link=2)
    assert floor.parent == Parent(ParentKind.UNIT, name="STN2")
    (attach,) = cell.attachments
    assert attach.objects == ("box", "ball")
    assert attach.reach_m == pytest.approx(0.005)
    assert attach.to == Parent(ParentKind.TOOL, name="pin", robot="left")
    by_clock, by_signal = cell.sources
    assert (by_clock.first_s, by_clock.every_s, by_clock.when) == (0.0, 2.0, "")
    assert (by_signal.first_s, by_signal.every_s, by_signal.when) == (None, None, "diMore")
    (sink,) = cell.sinks
    assert (sink.surface, sink.after_s, sink.capacity) == ("floor", 3.0, 10000)
    assert cell.clearance_m == pytest.approx(0.012)
    assert (cell.stops, cell.own_links) == (True, False)
    assert cell.ignored == (IgnoredPair("box", "link 3", "on purpose"),)


TRIANGLES = ("0 0 0", "1 0 0", "0 1 0", "0 0 1")


def tetrahedron(folder: Path, *, closed: bool = True) -> None:
    faces = ("1 3 2", "1 2 4", "1 4 3", "2 3 4")[: 4 if closed else 3]
    lines = [f"v {one}" for one in TRIANGLES] + [f"f {one}" for one in faces]
    (folder / "t.obj").write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize("unit", list(LengthUnit))
def test_a_mesh_is_as_long_as_its_unit_and_scale_say(unit: LengthUnit, tmp_path: Path) -> None:
    tetrahedron(tmp_path)
    text = f'[[object]]\nname = "a"\nmesh = "t.obj"\nunit = "{unit}"\nscale = 2\n'
    cell = station(text, tmp_path).geometry
    assert cell is not None
    assert np.ptp(cell.objects[0].shape.vertices, axis=0) == pytest.approx(2.0 * unit.in_m)


def test_a_mesh_that_fits_no_cell_is_refused(tmp_path: Path) -> None:
    tetrahedron(tmp_path, closed=False)
    named = '[[object]]\nname = "a"\nmesh = "t.obj"\nunit = "m"\n'
    with pytest.raises(InputError, match="is not closed, so it has no inside"):
        station(named, tmp_path)
    assert station(named + 'filling = "surface"\n', tmp_path).geometry is not None
    tetrahedron(tmp_path)
    with pytest.raises(InputError, match=r"t.obj would be 101000 mm long in m"):
        station(named + "scale = 101\n", tmp_path)
    with pytest.raises(InputError, match=r"t.obj would be 0.009 mm long in m"):
        station(named + "scale = 9e-6\n", tmp_path)


def test_tables_of_signals_stand_alone_too() -> None:
    found = read_io({"signals": {"a": {"type": "do"}}, "search": [{"position": (1, 2, 3)}]})
    assert [one.name for one in found.signals] == ["a"]
    with pytest.raises(InputError, match="robot: no such key"):
        read_io({"robot": {}})


def test_an_arm_is_bounded_as_its_backup_says() -> None:
    arm = load_robot("irb120")
    bounds = ((-1.0, 1.0), *[None] * 5)
    found = StationRobot("irb120", bounds=bounds).fitted(arm)
    assert (found.joints[0].lower, found.joints[0].upper) == (-1.0, 1.0)
    assert found.joints[1:] == arm.joints[1:]
    assert StationRobot("irb120", bounds=bounds[:5]).fitted(arm) is arm
    assert StationRobot(bounds=bounds).is_special
    assert StationRobot(shapes=Path()).is_special
    assert not StationRobot(bounds=(None,) * 6).is_special
    for count, guessed in ((None, True), (6, True), (4, False)):
        assert StationRobot(axis_count=count).can_be_guessed is guessed
    one = StationRobot("irb120-3-0.58")
    assert one.has_bounds_of("irb120")
    assert not one.has_bounds_of("irb140")
    assert StationRobot().has_bounds_of("irb140")


@pytest.mark.parametrize(
    ("text", "parent"),
    [
        ("world", Parent(ParentKind.WORLD)),
        ("tool", Parent(ParentKind.TOOL)),
        ("link:0", Parent(ParentKind.LINK, link=0)),
        ("link : 99", Parent(ParentKind.LINK, link=99)),
        ("unit:STN1:1", Parent(ParentKind.UNIT, name="STN1", link=1)),
        ("unit:STN1:6", Parent(ParentKind.UNIT, name="STN1", link=6)),
    ],
)
def test_a_body_is_fixed_to_its_parent(text: str, parent: Parent, tmp_path: Path) -> None:
    body = f'[[object]]\nname = "a"\nplane = true\nparent = "{text}"\n'
    cell = station(body, tmp_path).geometry
    assert cell is not None
    assert cell.objects[0].parent == parent
