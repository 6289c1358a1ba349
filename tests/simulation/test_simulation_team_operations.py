"""What one task asks of a robot that moves together with another counts for both of them."""

import numpy as np
import pytest
from simulation_tasks import Ran, ran
from test_simulation_team_refusals import DATA, point

SIDES = {"left": -1, "right": 1}


def asked(side: str, operation: str, *, meanwhile: str = "", zone: str = "z20") -> Ran:
    """Two robots make two moves together; between, one task asks and the other does something."""
    texts = {}
    for name, sign in SIDES.items():
        here, there = point(800, sign * 200, 700), point(800, sign * 150, 800)
        between = operation if name == side else meanwhile
        texts[name] = f"""{DATA.replace("T_ROB1", "LEFT").replace("T_ROB2", "RIGHT")}
PROC main()
  ConfL\\Off;
  ConfJ\\Off;
  MoveJ {here},v500,fine,tool0;
  SyncMoveOn on,both;
  MoveL {there}\\ID:=10,v200,{zone},tool0;
  {between.format(there=there)}
  MoveL {here}\\ID:=30,v200,fine,tool0;
  SyncMoveOff off;
ENDPROC
"""
    return ran({name.upper(): text for name, text in texts.items()}, max_time_s=30.0)


def together(it: Ran) -> list[tuple[tuple[float, float], ...]]:
    """When both robots made each move with \\ID."""
    both = ([m for m in it.moves(task) if m.move.sync_id] for task in ("LEFT", "RIGHT"))
    return [tuple((m.start_s, m.end_s) for m in pair) for pair in zip(*both, strict=True)]


@pytest.mark.parametrize("side", SIDES)
def test_stopmove_of_either_stops_both(side: str) -> None:
    it = asked(side, "WaitTime 0.2; StopMove; WaitTime 1; StartMove;")
    assert it.end == "ended"
    assert all(left == right for left, right in together(it))
    stands = np.array([1.6, 1.9])
    for robot in it.run.robots:
        before, after = robot.trajectory.at(stands).joints
        assert np.array_equal(before, after)


@pytest.mark.parametrize("side", SIDES)
def test_a_stop_holds_both_while_the_other_task_waits(side: str) -> None:
    free, held = (
        asked(side, f"WaitTime 0.2; {stop}", meanwhile="WaitTime 0.5;")
        for stop in ("", "StopMove; WaitTime 2; StartMove;")
    )
    assert held.end == "ended"
    assert all(left == right for left, right in together(held))
    assert held.run.time_s > free.run.time_s + 1.5


@pytest.mark.parametrize("side", SIDES)
def test_clearpath_of_either_forgets_the_way_of_both(side: str) -> None:
    it = asked(side, "StopMove; ClearPath; StartMove;")
    assert it.end == "ended"
    assert [pair[0][0] for pair in together(it)] == [pair[1][0] for pair in together(it)]
    for task in ("LEFT", "RIGHT"):
        assert [move.move.sync_id for move in it.moves(task)] == [None, 30.0]


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(
    ("instruction", "message"),
    [
        ("RestoPath", "RestoPath without StorePath: no path is kept"),
    ],
)
def test_no_path_is_kept_within_a_team(side: str, instruction: str, message: str) -> None:
    it = asked(side, f"{instruction};", zone="fine")
    assert message in it.only("R101").violation.message


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(
    ("operation", "message"),
    [
        ("SearchL diPart,found,{there}\\ID:=15,v100,tool0;", "SearchL without \\ID"),
        (
            "TriggIO near,5\\DOp:=doX,1; TriggL {there}\\ID:=15,v100,near,z10,tool0;",
            "moves that are made together need one number",
        ),
    ],
)
def test_searches_are_refused_and_triggers_keep_step(
    side: str, operation: str, message: str
) -> None:
    assert message in asked(side, operation).only("R101").violation.message


def test_a_world_zone_is_noticed_at_its_border() -> None:
    box = "WZBoxDef\\Inside,box,[0,-900,750],[900,900,1500]; WZDOSet\\Temp,zone\\Inside,box,doX,1;"
    it = asked("left", "", zone="fine")
    seen = asked("left", box)
    assert it.end == seen.end == "ended"
    left = next(robot for robot in seen.run.robots if robot.task == "LEFT")
    crossings = [time_s for time_s, _, text in seen.events if text.startswith("doX")]
    assert len(crossings) == 2
    heights = left.trajectory.at(np.array(crossings)).base_from_tcp.translation[:, 2]
    assert heights == pytest.approx([0.75, 0.75], abs=1e-4)
