"""A robot that works on what another robot carries: coordinated motion."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from simulation_tasks import JOINTS, Ran, ran

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.model import MODELS, Version
from rapidsim.motion.path.shared_path import PartPath
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.simulation.results.simulation import RobotRun

DATA = """
PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
VAR syncident on;
VAR syncident off;
VAR syncident there;
VAR syncident done;
VAR clock watch;
TASK PERS wobjdata held:=[FALSE,FALSE,"ROB_1",[[0,0,0],[1,0,0,0]],[[0,0,100],[0,1,0,0]]];
"""
FLANGE_FROM_OBJECT = Transform.from_quaternion((0.0, 1.0, 0.0, 0.0), np.array([0.0, 0.0, 0.1]))
FIRST = f"[[800,-200,700],[0,0,1,0],[-1,0,-1,0],{JOINTS}]"


def carrying(x: float, y: float, z: float, tilt: float = 0.0) -> str:
    turned = f"[0,{np.sin(np.radians(tilt) / 2)},{np.cos(np.radians(tilt) / 2)},0]"
    return f"[[{x},{y},{z}],{turned},[-1,0,-1,0],{JOINTS}]"


def on_part(x: float, y: float, z: float) -> str:
    return f"[[{x},{y},{z}],[0,0,1,0],[0,0,0,0],{JOINTS}]"


START = on_part(-100, 0, -300)
HOLDER = (
    "MoveL " + carrying(800, 0, 700),
    f"MoveC {carrying(850, 50, 780)},{carrying(800, 100, 860)}",
    "MoveJ " + carrying(700, 100, 900, tilt=20),
    "MoveL " + carrying(700, -100, 900),
)
LINES = tuple(
    "MoveL " + on_part(*at)
    for at in ((-100, 100, -300), (0, 100, -300), (0, 0, -250), (0, -50, -250))
)
MIXED = (
    "MoveJ " + on_part(-100, 100, -300),
    "MoveL " + on_part(0, 100, -300),
    f"MoveC {on_part(40, 50, -260)},{on_part(0, 0, -250)}",
    "MoveAbsJ [[40,40,10,0,40,30],[9E9,9E9,9E9,9E9,9E9,9E9]]",
)
AT_REST = (f"MoveL {START}",) * 4


def moves(of: tuple[str, ...], zone: str, wobj: str) -> str:
    zones = [zone] * (len(of) - 1) + ["fine"]
    return "\n".join(
        f"{move}\\ID:={number},v200,{at},tool0{wobj};"
        for number, (move, at) in enumerate(zip(of, zones, strict=True), start=1)
    )


def body(before: str, together: str) -> str:
    return f"""{DATA}
PROC main()
  ConfL\\Off;
  ConfJ\\Off;
  {before}
  SyncMoveOn on,both;
  {together}
  SyncMoveOff off;
ENDPROC
"""


@cache
def run(follows: tuple[str, ...], zone: str, model: Version = "1", between: str = "") -> Ran:
    holder = moves(HOLDER, zone, "").replace(";\nMoveC", f";\n{between}\nMoveC")
    first = f"WaitSyncTask there,both;\nMoveJ {START},v500,fine,tool0\\WObj:=held;"
    return ran(
        {
            "T_ROB1": body(f"MoveJ {FIRST},v500,fine,tool0;\nWaitSyncTask there,both;", holder),
            "T_ROB2": body(first, moves(follows, zone, r"\WObj:=held")),
        },
        model=MODELS[model],
    )


def on_object(one: Ran, times: Array) -> Transform:
    """The TCP of the second robot in what the flange of the first one carries."""
    holder, worker = one.run.robots
    flange = holder.robot.forward(holder.trajectory.at(times).joints)
    seen = worker.trajectory.at(times).base_from_tcp
    return (flange @ FLANGE_FROM_OBJECT).inverse() @ seen


def during(one: Ran, number: int, count: int = 25) -> Array:
    """Instants of a move of the second robot, from its start to its end."""
    move = one.moves("T_ROB2")[number]
    return np.linspace(move.start_s, move.end_s, count)


def off_line(points: Array, start: tuple[float, ...], end: tuple[float, ...]) -> float:
    """How far [mm] points (k, 3) [m] are from a line [mm]."""
    way = np.subtract(end, start)
    away = 1e3 * points - start
    along = (away @ way / (way @ way))[:, None]
    return float(np.abs(away - along * way).max())


@pytest.mark.parametrize(("model", "within_mm"), [("1", 1e-6), ("2", 0.05)])
def test_the_tcp_stays_on_its_line_in_the_moving_object(model: Version, within_mm: float) -> None:
    one = run(LINES, "fine", model)
    assert one.end == "ended"
    assert one.run.diagnostics == ()
    places = [(-100, 0, -300), (-100, 100, -300), (0, 100, -300), (0, 0, -250), (0, -50, -250)]
    for number, (start, end) in enumerate(pairwise(places), start=1):
        seen = on_object(one, during(one, number))
        assert off_line(seen.translation, start, end) < within_mm
        assert 1e3 * seen.translation[-1] == pytest.approx(end, abs=within_mm)
        assert np.abs(seen.rotation - np.diag([-1.0, 1.0, -1.0])).max() < 1e-3


@pytest.mark.parametrize(("model", "within_mm"), [("1", 1e-6), ("2", 0.05)])
@pytest.mark.parametrize("zone", ["fine", "z20"])
def test_who_rests_on_the_object_is_carried_along(
    zone: str, model: Version, within_mm: float
) -> None:
    one = run(AT_REST, zone, model)
    last = one.moves("T_ROB2")[-1]
    times = np.linspace(one.moves("T_ROB2")[1].start_s, last.end_s, 90)
    seen = 1e3 * on_object(one, times).translation
    assert seen == pytest.approx(np.broadcast_to((-100.0, 0.0, -300.0), (90, 3)), abs=within_mm)
    assert [move.length_m for move in one.moves("T_ROB2")[1:]] == pytest.approx([0.0] * 4, abs=1e-9)
    if model == "1":
        worker = one.run.robots[1].trajectory
        assert np.abs(np.diff(worker.at(times).joints[:, 0])).max() > 0.005
        assert worker.at(times).tcp_speed == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("follows", [LINES, MIXED, AT_REST])
@pytest.mark.parametrize("zone", ["fine", "z50"])
def test_all_members_begin_and_end_together(follows: tuple[str, ...], zone: str) -> None:
    one = run(follows, zone)
    holder, worker = (one.moves(task)[1:] for task in ("T_ROB1", "T_ROB2"))
    for mine, other in zip(worker, holder, strict=True):
        assert (mine.start_s, mine.end_s) == pytest.approx((other.start_s, other.end_s), abs=1e-6)
    corners = ["stop" if zone == "fine" else "fly-by"] * 3 + ["stop"]
    expected = corners if follows is not MIXED or zone == "fine" else None
    assert expected is None or [m.corner.value for m in worker] == expected


@pytest.mark.parametrize("follows", [LINES, MIXED])
@pytest.mark.parametrize("zone", ["fine", "z50"])
def test_limits_hold_and_derivatives_are_those_of_the_path(
    follows: tuple[str, ...], zone: str
) -> None:
    one = run(follows, zone)
    assert one.end == "ended"
    for robot in one.run.robots:
        _requires_limits(robot, one)
    paths = [p.path for p in one.run.robots[1].trajectory.pieces if isinstance(p.path, PartPath)]
    assert paths
    for path in paths:
        _requires_derivatives(path)


def _requires_limits(robot: RobotRun, one: Ran) -> None:
    limits = limits_of(robot.robot, one.run.model)
    samples = robot.trajectory.at(np.arange(0.0, one.run.time_s, 0.002))
    speed = np.diff(samples.joints, axis=0) / 0.002
    assert (np.abs(speed) <= limits.max_speed * 1.001).all()
    assert (np.abs(np.diff(speed, axis=0)) / 0.002 <= limits.max_acceleration * 1.02).all()
    together = samples.times > robot.moves[1].start_s
    assert samples.tcp_speed[together].max() <= 0.202


def _requires_derivatives(path: PartPath) -> None:
    bounds = path.layout.bounds
    joints = path.joints_at(bounds)
    near = path.joints_at(np.maximum(bounds - 1e-7, 0.0))
    assert np.abs(joints - near).max() < 1e-5
    for piece in np.flatnonzero(np.diff(bounds) > 1e-4):
        step = 1e-3 * (bounds[piece + 1] - bounds[piece])
        s = np.linspace(bounds[piece], bounds[piece + 1], 5)[1:-1]
        on = np.full(len(s), piece)
        rates = path.rates(s, on)
        first = (path.joints_at(s + step) - path.joints_at(s - step)) / (2 * step)
        ahead, behind = (path.rates(s + way, on).first for way in (step, -step))
        assert rates.first == pytest.approx(first, abs=1e-4 * (1 + np.abs(first).max()))
        second = (ahead - behind) / (2 * step)
        assert rates.second == pytest.approx(second, abs=1e-4 * (1 + np.abs(second).max()))


def test_programmed_speed_is_that_against_the_object() -> None:
    one = run(LINES, "fine")
    worker = one.run.robots[1].trajectory
    # Its own arc is the longer way: it sets the pace, at v200.
    assert worker.at(during(one, 3)[8:17]).tcp_speed == pytest.approx(0.2 * 0.1118 / 0.151, rel=0.5)
    assert max(worker.at(during(one, n)).tcp_speed.max() for n in (1, 2, 3, 4)) <= 0.2001


def alone(before: str, holder: str = "", more: str = "") -> Ran:
    """The second robot works by itself on what the first one holds."""
    meet = "WaitSyncTask there,both;"
    return ran(
        {
            "T_ROB1": _main(f"MoveJ {FIRST},v500,fine,tool0;\n{meet}\n{holder}"),
            "T_ROB2": _main(f"{meet}\n{before}") + more,
        },
        model=MODELS["1"],
    )


def _main(text: str) -> str:
    return f"{DATA}\nPROC main()\n  ConfL\\Off;\n  ConfJ\\Off;\n{text}\nENDPROC\n"


WORK = "\n".join(f"{move},v200,z10,tool0\\WObj:={{0}};" for move in LINES)


def test_on_an_object_held_at_rest_a_robot_moves_as_in_one_that_stands_there() -> None:
    held = alone(WORK.format("held"))
    first = held.run.robots[0]
    flange = first.robot.forward(first.trajectory.at(np.array([first.trajectory.duration])).joints)
    x, y, z = 1e3 * flange.translation[0]
    rotation = ",".join(map(repr, flange[0].quaternion.tolist()))
    frame = f"[[{x!r},{y!r},{z!r}],[{rotation}]]".replace("np.float64(", "").replace(")", "")
    stands = f'TASK PERS wobjdata stands:=[FALSE,TRUE,"",{frame},[[0,0,100],[0,1,0,0]]];'
    other = alone(WORK.format("stands"), more="\n" + stands)
    times = np.arange(0.0, held.run.time_s, 0.01)
    both = [one.run.robots[1].trajectory.at(times).joints for one in (held, other)]
    assert held.run.diagnostics == ()
    # Moves on a held object are planned in other windows, which divide the path into other stages.
    assert held.run.time_s == pytest.approx(other.run.time_s, abs=1e-5)
    assert both[0] == pytest.approx(both[1], abs=1e-5)


def test_positions_are_told_in_the_object_where_it_is() -> None:
    seen = r"TPWrite ValToStr(CPos(\Tool:=tool0\WObj:=held));"
    asked = alone(
        f"MoveJ {START},v500,fine,tool0\\WObj:=held;\n{seen}\nWaitSyncTask done,both;"
        f"WaitSyncTask off,both;\n{seen}",
        f"WaitSyncTask done,both;\nMoveL {carrying(800, -100, 700)},v100,fine,tool0;\n"
        "WaitSyncTask off,both;",
    )
    told = [text for _, text in asked.texts]
    places = [[round(float(x)) for x in one.strip("[]").split(",")] for one in told]
    assert places == [[-100, 0, -300], [-100, 100, -300]]


def test_joints_are_those_that_reach_the_object_where_it_is() -> None:
    asked = alone(
        f"MoveJ {START},v500,fine,tool0\\WObj:=held;\n"
        f"axes:=CalcJointT({START},tool0\\WObj:=held);\n"
        "TPWrite NumToStr(axes.robax.rax_1,3);\naxes:=CJointT();\n"
        "TPWrite NumToStr(axes.robax.rax_1,3);",
        more="VAR jointtarget axes;",
    )
    told = [text for _, text in asked.texts]
    assert len(told) == 2
    assert told[0] == told[1]


def test_nobody_works_on_an_object_that_moves_by_itself() -> None:
    moving = alone(
        f"WaitTime 0.3;\nMoveJ {START},v500,fine,tool0\\WObj:=held;",
        f"MoveL {carrying(800, 200, 700)},v100,fine,tool0;",
    )
    assert moving.end == "error"
    assert "is moving, and the robots are not synchronised" in moving.only("M523").violation.message
    assert not moving.moves("T_ROB2")


def test_an_object_that_begins_to_move_while_somebody_works_on_it_is_told() -> None:
    moved = alone(
        f"MoveJ {START},v500,fine,tool0\\WObj:=held;",
        f"WaitTime 0.5;\nMoveL {carrying(800, 200, 700)},v100,fine,tool0;",
    )
    assert moved.end == "ended"
    assert "ROB_1, which holds the work object, moves from 1." in (
        moved.only("M523").violation.message
    )


def test_two_robots_cannot_hold_each_others_objects() -> None:
    mine = 'TASK PERS wobjdata mine:=[FALSE,FALSE,"ROB_2",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];'
    there = "MoveJ {0},v500,fine,tool0;"
    circle = ran(
        {
            "T_ROB1": body(
                there.format(FIRST), f"MoveL {START}\\ID:=1,v200,fine,tool0\\WObj:=mine;"
            )
            + mine,
            "T_ROB2": body(
                there.format(FIRST), f"MoveL {START}\\ID:=1,v200,fine,tool0\\WObj:=held;"
            ),
        }
    )
    assert circle.end == "error"
    assert "waits for this robot in turn" in circle.only("M523").violation.message


def test_on_one_path_robots_cannot_take_turns_in_leading() -> None:
    mine = 'TASK PERS wobjdata mine:=[FALSE,FALSE,"ROB_2",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];'
    first = f"MoveL {carrying(800, -180, 700)}\\ID:=1,v200,{{0}},tool0;"
    back = "MoveL [[-90,0,-200],[0,0,1,0],[0,0,0,0],{0}]\\ID:=2,v200,fine,tool0\\WObj:=mine;"

    def turns(zone: str) -> Ran:
        return ran(
            {
                "T_ROB1": body(
                    f"MoveJ {FIRST},v500,fine,tool0;\nWaitSyncTask there,both;",
                    first.format(zone) + back.format(JOINTS),
                )
                + mine,
                "T_ROB2": body(
                    f"WaitSyncTask there,both;\nMoveJ {START},v500,fine,tool0\\WObj:=held;",
                    f"MoveL {START}\\ID:=1,v200,{zone},tool0\\WObj:=held;"
                    f"MoveL [[600,0,900],[0,0,1,0],[0,0,0,0],{JOINTS}]\\ID:=2,v200,fine,tool0;",
                ),
            }
        )

    refused = turns("z10")
    assert refused.end == "error"
    assert "a stop point between the moves parts the path" in (
        refused.run.diagnostics[-1].violation.message
    )


def test_a_stop_in_the_middle_keeps_the_robots_together() -> None:
    plain, stopped = (
        run(LINES, "z20"),
        run(LINES, "z20", between="WaitTime 0.2; StopMove; WaitTime 1; StartMove;"),
    )
    assert stopped.end == "ended"
    assert stopped.run.time_s > plain.run.time_s + 0.9
    worker = stopped.moves("T_ROB2")
    times = np.linspace(worker[1].start_s, worker[-1].end_s, 60)
    before, after = (-100, 0, -300), (-100, 100, -300)
    first = times[times < worker[1].start_s + 0.3]
    assert off_line(on_object(stopped, first).translation, before, after) < 1e-6
    end = on_object(stopped, np.array([worker[-1].end_s])).translation[0]
    assert 1e3 * end == pytest.approx((0, -50, -250), abs=1e-6)


def test_of_three_robots_each_may_work_on_what_the_one_before_carries() -> None:
    three = 'PERS tasks three{3}:=[["T_ROB1"],["T_ROB2"],["T_ROB3"]];\n'
    on_second = (
        'TASK PERS wobjdata second:=[FALSE,FALSE,"ROB_2",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];'
    )
    last = f"[[0,50,-100],[1,0,0,0],[0,0,0,0],{JOINTS}]"
    meet = "WaitSyncTask there,three; WaitSyncTask done,three;"
    programs = {
        "T_ROB1": body(f"MoveJ {FIRST},v500,fine,tool0;{meet}", moves(HOLDER, "z20", "")),
        "T_ROB2": body(
            f"WaitSyncTask there,three;MoveJ {START},v500,fine,tool0\\WObj:=held;"
            "WaitSyncTask done,three;",
            moves(LINES, "z20", r"\WObj:=held"),
        ),
        "T_ROB3": body(
            f"{meet}MoveJ {last},v500,fine,tool0\\WObj:=second;",
            moves((f"MoveL {last}",) * 4, "z20", r"\WObj:=second"),
        )
        + on_second,
    }
    programs = {
        task: three + text.replace("on,both", "on,three").replace("off,both", "off,three")
        for task, text in programs.items()
    }
    chain = ran(programs, model=MODELS["1"])
    assert chain.end == "ended", chain.run.diagnostics
    second, third = chain.run.robots[1:]
    times = np.linspace(third.moves[1].start_s, third.moves[-1].end_s, 40)
    carrier = second.robot.forward(second.trajectory.at(times).joints)
    seen = carrier.inverse() @ third.trajectory.at(times).base_from_tcp
    assert 1e3 * seen.translation == pytest.approx(
        np.broadcast_to((0.0, 50.0, -100.0), (40, 3)), abs=1e-6
    )


@pytest.mark.parametrize("zone", ["fine", "z20"])
def test_a_trigger_on_a_move_that_rests_on_the_object_acts_as_it_begins(zone: str) -> None:
    first = f"WaitSyncTask there,both;\nMoveJ {START},v500,fine,tool0\\WObj:=held;"
    trigger = "TriggEquip begun,0.001\\Start,0\\DOp:=doBegun,1;"
    carried = moves(AT_REST, zone, r"\WObj:=held").replace("MoveL", "TriggL")
    text = body(f"{first}\n{trigger}", carried.replace(",v200,", ",v200,begun,"))
    holder = body(
        f"MoveJ {FIRST},v500,fine,tool0;\nWaitSyncTask there,both;", moves(HOLDER, zone, "")
    )
    one = ran({"T_ROB1": holder, "T_ROB2": text + "VAR triggdata begun;"}, model=MODELS["1"])
    begun = one.moves("T_ROB2")[1].start_s
    assert one.end == "ended"
    assert [time_s for time_s, _, _ in one.events] == pytest.approx([begun], abs=0.03)
