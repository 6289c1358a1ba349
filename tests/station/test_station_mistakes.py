"""What each wrong value of a station file is answered with."""

from pathlib import Path

import pytest
from station_files import AXIS, station

from rapidsim.controller.cell.faults import FailureKind
from rapidsim.files import InputError
from rapidsim.station.faults import read_fault

BOX = '[[object]]\nname = "part"\nbox = [10, 20, 30]\n'
WRONG: list[tuple[str, str]] = [
    ("robots = 1", "robots: no such key"),
    ("robot = 1", "robot: a table is needed, as in [robot]"),
    ("task = 1", "task: they are written as [[task]]"),
    ("task = [1]", "task: they are written as [[task]]"),
    ("[robot]\nmodel = 1", "robot.model: text in quotes is needed"),
    ('[robot]\nmodel = "a"\nurdf = "b"', "robot: give `model` or `urdf`, not both"),
    ("[robot]\nscale = 2", "robot.scale: only lengths of a `urdf` are scaled"),
    ('[robot]\nurdf = "a"\nscale = 0', "robot.scale: must be greater than 0, not 0"),
    ('[robot]\nname = "left"', "robot.name: no such key"),
    ('[robot]\nshapes = "none"', "is not a folder"),
    ('[robot]\nshapes-unit = "mm"', "robot.shapes-unit: describes `shapes`, which are missing"),
    ("[robot]\nstart = 1", "robot.start: a list of numbers is needed"),
    ("[robot]\nstart = []", "robot.start: a list of numbers is needed"),
    ("[robot]\nstart = [1, true]", "robot.start: a list of numbers is needed"),
    ("[robot]\nbase = { position = [1, 2] }", "robot.base.position: 3 numbers are needed, not 2"),
    (
        "[robot]\nbase = { quaternion = [1, 1, 0, 0] }",
        "robot.base.quaternion: its length is 1.414, not 1",
    ),
    ('[[robot]]\nname = "A"\n[[robot]]\nname = "a"', "robot: two robots have one name"),
    ("[motion]\nacceleration_time = 0", "motion.acceleration_time: a number above 0 is needed"),
    (
        "[motion]\nfilter_time = -1",
        "motion.filter_time: a number that is not negative is needed",
    ),
    ("[motion]\nacceleration = [1, 0]", "motion.acceleration: accelerations must be above 0"),
    ("[motion]\naxis_speed = [0]", "motion.axis_speed: axis speeds must be above 0"),
    ("[motion]\nzone_share = 1.1", "motion.zone_share: a share is at most 1"),
    ("[dynamics]\ntorque = [1, 0, 1]", "dynamics.torque: factors must be above 0"),
    ("[dynamics]\nwrist = 1e400", "dynamics.wrist: a number that is not negative is needed"),
    (AXIS.replace('"b"', '"g"'), "external_axis.axis: `g` is none of a, b, c, d, e, f"),
    (AXIS.replace("[-90, 180]", "[5, 5]"), "external_axis.limits: the first must be below the"),
    (AXIS + "direction = [0, 0, 0]", "external_axis.direction: a direction must not be all zeros"),
    (AXIS.replace('kind = "rotational"\n', ""), "external_axis.kind: is missing"),
    (AXIS + AXIS, "external_axis: axis `b` is declared twice"),
    ('[[task]]\nname = "A"\n[[task]]\nname = "a"', "task 2.name: there are two tasks a"),
    (
        '[[task]]\nrobot = "x"\nmotion = false',
        "task.robot: a task with `motion = false` has no robot\n"
        "task T_ROB1.robot: there is no [[robot]] `x`",
    ),
    ('[[task]]\nrobot = "x"', "task T_ROB1.robot: there is no [[robot]] `x`"),
    (
        '[[robot]]\nname = "x"\n[[task]]\nname = "A"\nrobot = "x"\n'
        '[[task]]\nname = "B"\nrobot = "X"',
        "task B.robot: A moves that robot",
    ),
    (
        '[[task]]\nname = "A"\n[[task]]\nname = "B"\nmotion = true',
        "task B.motion: no robot is left for it; add a [[robot]]",
    ),
    ('[[task]]\ntype = "odd"', "task.type: `odd` is not a type"),
    ("[[task]]\nevents = { START = 1 }", "task.events.START: text in quotes is needed"),
    ('[[task]]\nevents = { BEGIN = "a" }', "task.events.BEGIN: no such key"),
    ('signals = { a = "di" }', "signals.a: a table is needed, as in { type ="),
    ("signals = { a = { value = 1 } }", "signals.a.type: unknown signal type ``; expected "),
    ('signals = { a = { type = "dx" } }', "signals.a.type: unknown signal type `dx`; expected "),
    ('signals = { a = { type = "di", width = 1 } }', "signals.a.width: a di has no such key"),
    ('signals = { a = { type = "gi", min = 1 } }', "signals.a.min: a gi has no such key"),
    ('signals = { a = { type = "gi", width = 0 } }', "signals.a.width: "),
    (
        'signals = { a = { type = "ao", min = 2, max = 2 } }',
        "signals.a.min: 2 is not below max, 2\nsignals.a.value: 0 is outside its limits 2.0 .. 2.0",
    ),
    (
        'signals = { a = { type = "ao", min = 1, max = 2 } }',
        "signals.a.value: 0 is outside its limits 1.0 .. 2.0",
    ),
    (
        'signals = { a = { type = "gi", width = 2, value = 4 } }',
        "signals.a.value: 4 is outside its limits 0.0 .. 3.0",
    ),
    (
        'signals = { a = { type = "di", value = -1 } }',
        "signals.a.value: -1 is outside its limits 0.0 .. 1.0",
    ),
    (
        'signals = { a = { type = "do", action = "Start" } }',
        "signals.a.action: a do causes no action; a di does",
    ),
    (
        'signals = { a = { type = "do", task = "T" } }',
        'signals.a.task: it needs `system`, as in system = "TaskExecuting"',
    ),
    (
        'signals = { a = { type = "di" }, A = { type = "di" } }',
        "signals.A: `a` is declared already",
    ),
    (
        '[[cross]]\nset = "a"\nfrom = "b"\n[[cross]]\nset = "b"\nfrom = "not A"',
        "cross 1: `a` depends on itself\ncross 2: `b` depends on itself",
    ),
    ('[[cross]]\nset = "a"\nfrom = "b and"', "cross.from: \ncross: both are needed"),
    ("[[stimulus]]\nset = { a = 1 }", "stimulus: give `at`, `every` or `when`"),
    (
        '[[stimulus]]\nwhen = "a = 1"\nat = 1\nset = { a = 1 }',
        "stimulus: `when` waits for signals, `at` and `every` for the clock; give one",
    ),
    (
        "[[stimulus]]\nevery = 1\npulse = 1\nset = { a = 1 }",
        "stimulus.pulse: 1 s is not shorter than every, 1 s",
    ),
    (
        "[[stimulus]]\nat = 1\nskip = [1]\nset = { a = 1 }",
        "stimulus.skip: it counts how often `when` is met, or `every`",
    ),
    (
        "[[stimulus]]\nevery = 1\nskip = [0]\nset = { a = 1 }",
        "stimulus.skip: whole numbers from 1 up are needed; the first time is 1",
    ),
    (
        "[[stimulus]]\nevery = 1\nskip = [1.5]\nset = { a = 1 }",
        "stimulus.skip: whole numbers from 1 up are needed; the first time is 1",
    ),
    ('[[fault]]\nkind = "odd"\nat = 1', "fault.kind: `odd` is not a\nfault.kind: name the kind"),
    ('[[fault]]\nkind = "device_lost"\nat = 1', "fault.device: name the device"),
    ('[[fault]]\nkind = "emergency_stop"', "fault: give `at`, `every` or `when`"),
    (
        '[[fault]]\nkind = "emergency_stop"\nat = 1\ndevice = "d"',
        "fault.device: emergency_stop has no such key; its own keys: ",
    ),
    ("[[socket]]\nudp = true", "socket: give either `accept` for a server or `connect` for a"),
    ("[[socket]]\naccept = 1\nconnect = 2", "socket: give either `accept` for a server or"),
    ("[[socket]]\naccept = 0", "socket.accept: a port is needed, as in 5000 or"),
    ("[[socket]]\naccept = 65536", "socket.accept: a port is needed, as in 5000 or"),
    ('[[socket]]\naccept = "1.2.3.4"', "socket.accept: a port is needed, as in 5000 or"),
    ("[[socket]]\naccept = 1\nafter = 2", "socket.after: only for peers that `connect`"),
    (
        "[[socket]]\nconnect = 1\nudp = true\nreconnect = true",
        "socket.reconnect: datagrams need no connection",
    ),
    (
        "[[socket]]\nconnect = 1\nudp = true\nsteps = [{ close = true }]",
        "socket.steps: no connection can be closed: `udp` has none",
    ),
    (
        '[[socket]]\naccept = 1\nrepeat = true\nsteps = [{ send = "a" }]',
        "socket.repeat: a step must `expect` something or wait with `after`",
    ),
    ("[[socket]]\naccept = 1\nsteps = [{}]", "socket.steps: give what happens, as in { expect"),
    (
        '[[socket]]\naccept = 1\nsteps = [{ send = "Δ" }]',
        "the controller sends ISO 8859-1, which lacks some of this",
    ),
    ("[[camera]]\nafter = 1", "camera.name: is missing"),
    ('[[camera]]\nname = "c"\npictures = [1]', "camera.pictures: a list of lists is needed"),
    ('[[camera]]\nname = "c"\npictures = [[1]]', "camera.pictures 1: write what is found as {"),
    (
        '[[camera]]\nname = "c"\nparameters = { a = [1] }',
        "camera.parameters.a: a number, a text, true or false is needed",
    ),
    ('[[search]]\nwobj = "w"', "search.position: is missing: [0, 0, 0] where the part is as"),
    ('[gripper]\nclose = "doGrip ="', "gripper.close: \ngripper: name what closes it"),
    ('[controller]\nrobotware = "six"', "controller.robotware: `six` is not a version"),
    ('[controller]\nstubs = ["../a.mod"]', "controller.stubs: "),
    ("[clock]\nstart = 5", "clock.start: a date with a time is needed, as in 2025-03-01T06:00:00"),
    ("[check]\nselect = [1]", "check.select: a list of texts is needed"),
    ('[check]\nstrict = "yes"', "check.strict: true or false is needed"),
    ('[check]\nfail-on = "Error"', "check.fail-on: `Error` is not a severity"),
    ("[check]\ncycle-budget = 0", "check.cycle-budget: a number above 0 is needed"),
    ("[check.per-file-ignores]\na = 1", "check.per-file-ignores.a: a list of texts is needed"),
    ("[[object]]\nbox = [1, 1, 1]", "object.name: is missing"),
    ('[[object]]\nname = ""\nplane = true', "object.name: is missing"),
    ('[[object]]\nname = "a"', "object: one of box, cylinder, sphere, capsule, plane, mesh is"),
    (BOX + "plane = true", "object: one of box, cylinder, sphere, capsule, plane, mesh is needed"),
    (BOX + 'unit = "mm"', "object.unit: a box has no such key"),
    (BOX + "scale = 2", "object.scale: a box has no such key"),
    (BOX.replace("30", "0.001"), "object.box: lengths are from 0.01 to 100000 mm"),
    (BOX.replace("30", "100001"), "object.box: lengths are from 0.01 to 100000 mm"),
    (BOX + 'colour = "red"', "object.colour: `red` is not a colour, such as `#6080a0`"),
    (BOX + "pose = { position = [1000001, 0, 0] }", "object.pose: more than a kilometre away"),
    (BOX + 'parent = "link:100"', "object.parent: `link:100` is none of `world`, `wobj:NAME`"),
    (BOX + 'parent = "world:x"', "object.parent: `world:x` is none of `world`"),
    (BOX + 'parent = "wobj:"', "object.parent: `wobj:` is none of `world`"),
    (BOX + 'parent = "unit:STN1:7"', "object.parent: `unit:STN1:7` is none of `world`"),
    (BOX + 'parent = "unit:STN1:0"', "object.parent: `unit:STN1:0` is none of `world`"),
    (BOX + BOX.replace("part", "PART"), "object 2.name: another object is called `PART`"),
    (
        '[[object]]\nname = "a"\nplane = false',
        "object.plane: plane = true; everything below its x and y axes is solid",
    ),
    (
        '[[object]]\nname = "a"\ncapsule = { diameter = 10, length = 10 }',
        "object.capsule.length: with both ends it is longer than the diameter",
    ),
    (
        '[[object]]\nname = "a"\nsphere = { diameter = 0.001 }',
        "object.sphere: lengths are from 0.01 to 100000 mm",
    ),
    (
        '[[object]]\nname = "a"\ncylinder = { diameter = 1, length = 1e6 }',
        "object.cylinder: lengths are from 0.01 to 100000 mm",
    ),
    (
        '[[object]]\nname = "a"\nmesh = "a.stl"',
        "object.unit: the file does not give one",
    ),
    ('[[object]]\nname = "a"\nmesh = "a.stl"\nunit = "mm"', "object.mesh: "),
    (BOX + '[[attach]]\nwhen = "a"\nobject = "parts"\nto = "tool"', "attach.object: there is no"),
    (
        BOX + '[[attach]]\nwhen = "a"\nobject = "part"\nto = "tool:jaw"',
        "attach.to: there is no object `jaw`",
    ),
    (
        BOX + '[[attach]]\nwhen = "a"\nobject = "part"\nto = "world"',
        "attach.to: `world` is none of `tool`, `tool:NAME`, `unit:NAME`, `unit:NAME:AXIS`",
    ),
    (BOX + '[[source]]\nobject = "part"', "source: give `at`, `every`, `times` or `when`"),
    (BOX + '[[source]]\nobject = "p"\nat = 1', "source.object: there is no object `p`"),
    (
        BOX + '[[source]]\nobject = "part"\nevery = 1\nwhen = "a"',
        "source.every: `when` waits for signals, the other keys for the clock; give one",
    ),
    (BOX + '[[sink]]\non = "part"\nholds = 0', "sink.holds: "),
    (BOX + '[[sink]]\non = "p"', "sink.on: there is no object `p`"),
    (
        '[collisions]\nignore = [{ between = ["a"], reason = "b" }]',
        'collisions.ignore: write { between = ["fence", "link 3"], reason = "why they may touch" }',
    ),
    (
        '[collisions]\nignore = [{ between = ["a", "b"] }]',
        'collisions.ignore: write { between = ["fence", "link 3"], reason',
    ),
]


@pytest.mark.parametrize(("text", "message"), WRONG)
def test_each_mistake_has_its_place_and_its_sentence(
    text: str, message: str, tmp_path: Path
) -> None:
    with pytest.raises(InputError) as caught:
        station(text, tmp_path)
    lines = caught.value.message.splitlines()
    for line, part in zip(lines, message.splitlines(), strict=True):
        assert part in line


@pytest.mark.parametrize(
    ("text", "help"),
    [
        ('[robot]\nmodell = "a"', "did you mean `model`?"),
        ("[clock]\nxyz = 1", "known here: start"),
        (BOX + '[[sink]]\non = "prat"', "did you mean `part`?"),
        (BOX + '[[sink]]\non = "zz"', "there are part"),
        ('[[sink]]\non = "zz"', "there are none"),
        ('[[robot]]\nname = "left"\n[[task]]\nrobot = "lef"', "did you mean `left`?"),
        ('[[robot]]\nname = "left"\n[[task]]\nrobot = "xyz"', "robots: left"),
        ('[controller]\nrobotware = "six"', 'such as "6.15" or "7.13"'),
        ('[controller]\nstubs = ["../a.mod"]', "only what lies in the folder of this file may be"),
    ],
)
def test_a_mistake_comes_with_what_would_be_right(text: str, help: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        station(text, tmp_path)
    assert help in str(caught.value.help)


def test_a_fault_of_a_test_may_begin_at_once_but_not_in_two_ways() -> None:
    assert read_fault({"kind": "emergency_stop"}).kind is FailureKind.EMERGENCY_STOP
    assert read_fault({"kind": "device_lost", "device": "d652", "at": 2}).at_s == 2.0
    for values, message in (
        ({"kind": "emergency_stop", "at": 1, "when": "a"}, "fault: `when` waits for signals"),
        ({"kind": "emergency_stop", "at": 1, "nth": (1,)}, "fault.nth: it counts how often"),
        ({"kind": "device_lost"}, "fault.device: name the device"),
        ({}, "fault.kind: name the kind"),
        ({"kind": "emergency_stop", "odd": 1}, "fault.odd: no such key"),
    ):
        with pytest.raises(InputError) as caught:
            read_fault(values)
        assert message in caught.value.message
