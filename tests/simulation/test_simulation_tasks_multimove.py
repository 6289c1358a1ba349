"""Two robots that move together between SyncMoveOn and SyncMoveOff."""

from functools import cache, partial

import numpy as np
import pytest
import simulation_tasks
from simulation_tasks import JOINTS, Ran

from rapidsim.controller.journal.events import EventKind
from rapidsim.motion.model import MODELS
from rapidsim.motion.timing.axis_limits import limits_of

ran = partial(simulation_tasks.ran, model=MODELS["1"])
"""With the arms exactly on their paths."""

DATA = """
PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
VAR syncident on;
VAR syncident off;
"""
LEFT = ((800, -200, 700), (800, 0, 700), (800, 0, 900), (700, 100, 900))
RIGHT = ((800, 200, 700), (800, 100, 700), (800, 100, 1000), (800, 200, 700))


def point(x: float, y: float, z: float) -> str:
    turn = -1 if y < 0 else 0
    return f"[[{x},{y},{z}],[0,0,1,0],[{turn},0,{-1 if y < 0 else 0},0],{JOINTS}]"


def program(
    points: tuple[tuple[float, float, float], ...],
    *,
    speed: str = "v200",
    zone: str = "z20",
    between: str = "",
    before: str = "",
    ids: tuple[int, ...] = (10, 20, 30),
) -> str:
    first, *others = points
    zones = [zone] * (len(others) - 1) + ["fine"]
    moves = "\n".join(
        f"MoveL {point(*to)}\\ID:={number},{speed},{at},tool0;\n{between}"
        for to, number, at in zip(others, ids, zones, strict=True)
    )
    return f"""{DATA}
PROC main()
  ConfL\\Off;
  ConfJ\\Off;
  MoveJ {point(*first)},v500,fine,tool0;
  {before}
  SyncMoveOn on,both;
  {moves}
  SyncMoveOff off;
  TPWrite GetTaskName() + " alone";
ENDPROC
"""


@cache
def together() -> Ran:
    return ran({"T_ROB1": program(LEFT), "T_ROB2": program(RIGHT)})


def test_moves_of_one_number_begin_and_end_together() -> None:
    left, right = (together().moves(task)[1:] for task in ("T_ROB1", "T_ROB2"))
    assert together().end == "ended"
    assert [(m.start_s, m.end_s) for m in left] == [(m.start_s, m.end_s) for m in right]
    assert [round(m.length_m, 4) for m in left] == [0.2, 0.2, 0.1414]
    assert [round(m.length_m, 4) for m in right] == [0.1, 0.3, 0.3162]
    assert [m.corner.value for m in right] == ["fly-by", "fly-by", "stop"]
    assert [m.zone_m for m in right] == [0.02, 0.02, 0.0]


def test_between_they_are_equally_far_on_their_ways() -> None:
    left, right = together().run.robots
    first = left.moves[1]
    times = np.linspace(first.start_s, first.start_s + 0.8 * (first.end_s - first.start_s), 9)
    shares = []
    for robot, start, length in ((left, LEFT[0], 0.2), (right, RIGHT[0], 0.1)):
        position = robot.trajectory.at(times).base_from_tcp.translation
        shares.append(np.linalg.norm(position - np.array(start) / 1000.0, axis=1) / length)
    assert shares[0] == pytest.approx(shares[1], abs=1e-9)
    assert shares[0][-1] > 0.7


def test_both_robots_are_at_known_places_at_the_same_instants() -> None:
    left, right = together().run.robots
    times = left.moves[1].start_s + np.array([0.25, 1.0, 2.0, 3.5])
    places = [
        robot.trajectory.at(times).base_from_tcp.translation * 1000.0 for robot in (left, right)
    ]
    assert places[0] == pytest.approx(np.array(LEFT_SEEN), abs=1.0)
    assert places[1] == pytest.approx(np.array(RIGHT_SEEN), abs=1.0)


LEFT_SEEN = [
    (800.0, -159.4, 700.0),
    (800.0, -11.9, 700.3),
    (800.0, 0.0, 827.6),
    (738.0, 62.0, 900.0),
]
RIGHT_SEEN = [
    (800.0, 179.7, 700.0),
    (800.0, 104.8, 702.8),
    (800.0, 100.0, 891.5),
    (800.0, 162.0, 814.0),
]


def test_no_axis_and_no_tcp_is_faster_than_it_may_be() -> None:
    for robot in together().run.robots:
        limits = limits_of(robot.robot, together().run.model)
        times = np.arange(0.0, together().run.time_s, 0.002)
        samples = robot.trajectory.at(times)
        speed = np.abs(np.diff(samples.joints, axis=0)) / 0.002
        assert (speed <= limits.max_speed * 1.001).all()
        acceleration = np.abs(np.diff(samples.joints, 2, axis=0)) / 0.002**2
        assert (acceleration <= limits.max_acceleration * 1.02).all()
        begin = robot.moves[1].start_s
        assert samples.tcp_speed[times > begin].max() <= 0.2012


def test_the_robot_with_the_longer_way_decides() -> None:
    alone = ran({"T_ROB1": program(RIGHT, ids=(1, 2, 3)).replace("SyncMoveOff off;", "")})
    slow = alone.moves("T_ROB1")
    idle = tuple((800.0 + k, -200.0, 700.0) for k in range(4))
    it = ran({"T_ROB1": program(RIGHT), "T_ROB2": program(idle)})
    moves = it.moves("T_ROB1")
    assert moves[3].end_s - moves[1].start_s == pytest.approx(
        slow[3].end_s - slow[1].start_s, rel=2e-3
    )
    assert np.ptp(it.run.robots[1].trajectory.at([1.9, 9.0]).joints, axis=0).max() > 0.0  # type: ignore[arg-type]


def test_a_robot_that_stands_may_take_part() -> None:
    standing = ((800.0, -200.0, 700.0),) * 4
    it = ran({"T_ROB1": program(standing), "T_ROB2": program(RIGHT)})
    assert it.end == "ended"
    left, right = (it.moves(task)[1:] for task in ("T_ROB1", "T_ROB2"))
    assert [m.end_s for m in left] == [m.end_s for m in right]
    begin = left[0].start_s
    samples = it.run.robot_of("T_ROB1").trajectory.at(
        np.array([begin, begin + 1.0, left[-1].end_s])
    )
    assert np.ptp(samples.joints, axis=0).max() < 1e-9


def test_one_robot_that_stops_stops_both() -> None:
    fine = program(RIGHT).replace("\\ID:=10,v200,z20", "\\ID:=10,v200,fine")
    it = ran({"T_ROB1": program(LEFT), "T_ROB2": fine})
    for task in ("T_ROB1", "T_ROB2"):
        assert [m.corner.value for m in it.moves(task)[1:]] == ["stop", "fly-by", "stop"]


def test_logic_after_a_fly_by_happens_when_both_start_that_move() -> None:
    it = ran(
        {"T_ROB1": program(LEFT, between="SetDO done,1;\nSetDO done,0;"), "T_ROB2": program(RIGHT)}
    )
    starts = [move.start_s for move in it.moves("T_ROB1")[1:3]]
    set_at = [time_s for time_s, _, what in it.events if what == "done = 1"]
    # The arm is seen to pass the point half the smoothing later than it is commanded.
    assert set_at[:2] == pytest.approx([starts[0], starts[1] - 0.04], abs=2e-3)
    assert [m.corner.value for m in it.moves("T_ROB2")[1:]] == ["fly-by", "fly-by", "stop"]


def test_looking_at_the_time_changes_nothing() -> None:
    looks = program(LEFT, between="reg1:=ClkRead(clock1);", before="ClkStart clock1;")
    it = ran({"T_ROB1": looks, "T_ROB2": program(RIGHT)})
    for task in ("T_ROB1", "T_ROB2"):
        pairs = zip(it.moves(task), together().moves(task), strict=True)
        for looked, lazily in pairs:
            assert looked.start_s == pytest.approx(lazily.start_s, abs=1e-3)
            assert looked.end_s == pytest.approx(lazily.end_s, abs=1e-3)


def test_a_task_that_thinks_too_long_makes_both_stop_at_the_corner() -> None:
    slow = program(RIGHT).replace(
        "MoveL " + point(*RIGHT[2]), "WaitTime 3;\nMoveL " + point(*RIGHT[2])
    )
    it = ran({"T_ROB1": program(LEFT), "T_ROB2": slow})
    failed = "stop(corner path failure)"
    for task in ("T_ROB1", "T_ROB2"):
        assert [m.corner.value for m in it.moves(task)[1:]] == [failed, "fly-by", "stop"]


def test_both_go_on_alone_after_syncmoveoff() -> None:
    end_s = together().moves("T_ROB1")[-1].end_s
    alone = [(time_s, text) for time_s, _, text in together().events]
    assert [text for _, text in alone] == ["T_ROB1 alone", "T_ROB2 alone"]
    assert [time_s for time_s, _ in alone] == pytest.approx([end_s, end_s], abs=2e-3)


def test_stopmove_stops_both_and_startmove_lets_both_go_on() -> None:
    stops = """
VAR intnum alarm;
TRAP heard
  StopMove;
  WaitTime 1;
  StartMove;
ENDTRAP
"""
    text = stops + program(LEFT, before="CONNECT alarm WITH heard;\nITimer\\Single,1.2,alarm;")
    it = ran({"T_ROB1": text.replace("v200", "v50"), "T_ROB2": program(RIGHT, speed="v50")})
    assert it.end == "ended"
    left, right = it.run.robots
    assert [m.end_s for m in left.moves[1:]] == [m.end_s for m in right.moves[1:]]
    trap_s = next(e.time_s for e in it.run.events if e.kind.value == "interrupt")
    for robot in (left, right):
        samples = robot.trajectory.at(trap_s + np.array([0.4, 0.8]))
        assert np.ptp(samples.joints, axis=0).max() < 1e-9


@pytest.mark.parametrize(
    ("left", "right", "message"),
    [
        (program(LEFT, ids=(10, 20, 30)), program(RIGHT, ids=(10, 21, 30)), "need one number"),
        (program(LEFT).replace("\\ID:=20", ""), program(RIGHT), "without \\ID between"),
        (program(LEFT).replace("SyncMoveOn on,both;", ""), program(RIGHT), "without SyncMoveOn"),
    ],
)
def test_moves_that_do_not_belong_together_are_errors(left: str, right: str, message: str) -> None:
    it = ran({"T_ROB1": left, "T_ROB2": right})
    assert it.end == "error"
    assert any(message in d.violation.message for d in it.run.diagnostics)


@pytest.mark.parametrize(
    ("trigger", "task", "before_mm"),
    [
        ("TriggEquip half,40,0\\DOp:=doHalf,1;", "T_ROB1", 40.0),
        ("TriggEquip half,40,0\\DOp:=doHalf,1;", "T_ROB2", 40.0),
        ("TriggIO half,30\\Start\\DOp:=doHalf,1;", "T_ROB2", -30.0),
        ("TriggIO half,0\\DOp:=doHalf,1;", "T_ROB2", 0.0),
    ],
)
def test_outputs_on_moves_made_together_are_set_where_the_robot_is(
    trigger: str, task: str, before_mm: float
) -> None:
    data = "VAR syncident on;\nVAR triggdata half;"

    def with_trigger(text: str) -> str:
        text = text.replace("VAR syncident on;", data).replace(
            "SyncMoveOn on", f"{trigger} SyncMoveOn on"
        )
        return text.replace("MoveL", "TriggL").replace(",v200,", ",v200,half,")

    programs = {"T_ROB1": program(LEFT, zone="fine"), "T_ROB2": program(RIGHT, zone="fine")}
    plain = ran(programs)
    triggered = ran({**programs, task: with_trigger(programs[task])})
    assert triggered.end == "ended"
    assert triggered.run.unsimulated == ()
    (robot,) = [one for one in triggered.run.robots if one.task == task]
    (first, *_) = [event for event in triggered.run.events if event.kind is EventKind.SIGNAL]
    start, end = (LEFT if task == "T_ROB1" else RIGHT)[:2]
    here = robot.trajectory.at(np.array([first.time_s])).base_from_tcp.translation[0] * 1000.0
    # Nearer than by a millisecond at 200 mm/s.
    wanted = (end, before_mm) if before_mm >= 0.0 else (start, -before_mm)
    assert np.linalg.norm(here - wanted[0]) == pytest.approx(wanted[1], abs=0.2)
    for one in ("T_ROB1", "T_ROB2"):
        ends = [move.end_s for move in triggered.moves(one)]
        assert ends == pytest.approx([move.end_s for move in plain.moves(one)], abs=1e-6)


def test_a_trap_at_a_place_of_a_move_made_together_runs_there() -> None:
    data = "VAR syncident on;\nVAR triggdata begun;\nVAR intnum number;"
    left = program(LEFT).replace("VAR syncident on;", data)
    connect = "CONNECT number WITH told; TriggInt begun,0.001\\Start,number;"
    left = left.replace("SyncMoveOn on", f"{connect} SyncMoveOn on")
    left = left.replace("MoveL", "TriggL").replace(",v200,", ",v200,begun,")
    left += '\nTRAP told\n  TPWrite "begun";\nENDTRAP\n'
    it = ran({"T_ROB1": left, "T_ROB2": program(RIGHT)})
    assert it.end == "ended"
    starts = [move.start_s for move in it.moves("T_ROB1")[1:]]
    begun = [time_s for time_s, text in it.texts if text == "begun"]
    assert begun == pytest.approx(starts, abs=0.02)


def test_a_move_nobody_makes_with_it_ends_the_run() -> None:
    fewer = program(RIGHT[:3], ids=(10, 20))
    it = ran({"T_ROB1": program(LEFT), "T_ROB2": fewer})
    message = it.only("R106").violation.message
    assert "T_ROB1 at T_ROB1.mod:" in message
    assert "T_ROB2 at T_ROB2.mod:" in message


def test_a_point_one_of_them_cannot_reach_is_told_at_its_line() -> None:
    far = (*RIGHT[:2], (3000.0, 0.0, 700.0), RIGHT[3])
    it = ran({"T_ROB1": program(LEFT), "T_ROB2": program(far)})
    (found,) = [d for d in it.run.diagnostics if d.severity == "error"]
    assert (it.end, found.span and found.span.file) == ("error", "T_ROB2.mod")


def test_alone_in_a_run_the_moves_are_made_without_waiting() -> None:
    it = ran({"T_ROB1": program(LEFT)})
    assert (it.end, len(it.run.moves)) == ("ended", 4)
    assert [one.name for one in it.run.unsimulated] == ["SyncMoveOn"]


def test_two_runs_are_equal_to_the_last_bit() -> None:
    again = ran({"T_ROB1": program(LEFT), "T_ROB2": program(RIGHT)})
    for one, other in zip(again.run.robots, together().run.robots, strict=True):
        assert one.trajectory.joints.tobytes() == other.trajectory.joints.tobytes()


def test_stopmove_for_all_stops_the_robots_of_other_tasks_too() -> None:
    far = f"MoveAbsJ [[80,0,0,0,30,0],{JOINTS}],v100,fine,tool0;"
    statements = "WaitTime 2;\nStopMove\\AllMotionTasks;\nWaitTime 1;\nStartMove\\AllMotionTasks;"
    it = ran(
        {
            "T_ROB1": f"PROC main()\n{far}\nENDPROC",
            "T_WATCH": f"PROC main()\n{statements}\nENDPROC",
        },
        robots=("T_ROB1",),
    )
    times = np.array([1.9, 2.5, 3.0, 4.0])
    turned = it.run.robot_of("T_ROB1").trajectory.at(times).joints[:, 0]
    assert turned[0] < turned[1] < turned[3]
    assert turned[2] == pytest.approx(turned[1], abs=1e-9)
    assert it.moves("T_ROB1")[0].corner.value == "stop"
    assert it.run.robot_of("T_ROB1").trajectory.at(np.array([99.0])).joints[0, 0] == pytest.approx(
        np.radians(80.0)
    )


@pytest.mark.parametrize("alone", ["SyncMoveUndo;", "SyncMoveSuspend;"])
def test_for_a_while_each_may_move_alone(alone: str) -> None:
    again = "SyncMoveResume;" if "Suspend" in alone else "SyncMoveOn again,both;"
    aside = f"MoveAbsJ [[60,0,0,0,30,0],{JOINTS}],v500,fine,tool0;"
    data = "VAR syncident again;"
    texts = []
    for points, moves in ((LEFT, f"{aside}\n"), (RIGHT, "")):
        text = program(points, zone="fine")
        second = "MoveL " + point(*points[2])
        between = f'{alone}\nTPWrite "alone "+ValToStr(IsSyncMoveOn());\n{moves}{again}\n'
        texts.append(data + text.replace(second, between + second))
    it = ran({"T_ROB1": texts[0], "T_ROB2": texts[1]})
    assert it.end == "ended"
    left, right = it.moves("T_ROB1"), it.moves("T_ROB2")
    assert [m.move.sync_id for m in left] == [None, 10, None, 20, 30]
    for one, other in zip(left[3:], right[2:], strict=True):
        assert one.start_s == pytest.approx(other.start_s, abs=1e-6)
        assert one.end_s == pytest.approx(other.end_s, abs=1e-6)
    assert left[2].end_s > left[1].end_s + 1.0
    assert {text for _, text in it.texts if text.startswith("alone")} == {"alone FALSE"}


def test_startmove_wakes_a_task_that_waits_for_the_team_to_go_on() -> None:
    stop = "CONNECT alarm WITH heard;\nITimer 0.5,alarm;"
    traps = "VAR intnum alarm;\nTRAP heard\nENDTRAP\n"
    stops = program(LEFT, before=stop, between="StopMove;\nWaitTime 0.2;\nStartMove;")
    it = ran(
        {"T_ROB1": traps + stops, "T_ROB2": program(RIGHT, between="PulseDO done;")},
        max_time_s=60.0,
    )
    assert it.end == "ended"
    # What was stopped on the way, before any of it was fixed, begins where the move before ended.
    moves = it.moves("T_ROB1")
    assert [m.start_s for m in moves[2:]] == pytest.approx([m.end_s for m in moves[1:-1]])


@pytest.mark.parametrize("task", ["T_ROB1", "T_ROB2"])
def test_a_ramp_on_a_move_made_together_goes_over_its_way(task: str) -> None:
    data = "VAR syncident on;\nVAR triggdata ramp;"
    programs = {"T_ROB1": program(LEFT, zone="fine"), "T_ROB2": program(RIGHT, zone="fine")}
    text = programs[task].replace("VAR syncident on;", data)
    text = text.replace("SyncMoveOn on", "TriggRampAO ramp,40,0,aoFlow,10,20; SyncMoveOn on")
    text = text.replace("MoveL", "TriggL", 1).replace(",v200,", ",v200,ramp,", 1)
    it = ran({**programs, task: text})
    (robot,) = [one for one in it.run.robots if one.task == task]
    flow = [event for event in it.run.events if event.kind is EventKind.SIGNAL]
    values = np.array([float(str(event.details["value"])) for event in flow])
    times = np.array([event.time_s for event in flow])
    end = (LEFT if task == "T_ROB1" else RIGHT)[1]
    there = robot.trajectory.at(times).base_from_tcp.translation * 1000.0
    left_mm = np.linalg.norm(there - end, axis=1)
    assert values == pytest.approx(np.clip((40.0 - left_mm) / 2.0, 0.0, 10.0), abs=0.05)
