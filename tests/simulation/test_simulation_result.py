"""What a run leaves behind, of one robot and of several alike."""

from dataclasses import replace
from functools import cache

import pytest
from simulation_program import ran as ran_alone
from simulation_tasks import JOINTS, Ran, ran

from rapidsim.controller.journal.events import EventKind
from rapidsim.files import InputError

TURN = f"MoveAbsJ [[40,0,0,0,30,0],{JOINTS}],v1000,fine,tool0;"
LATE = f"MoveAbsJ [[60,0,0,0,30,0],{JOINTS}],v1000,z50,tool0; WaitTime 9;"


@cache
def three_tasks() -> Ran:
    """A robot with one move, one with three, of which one stops in a corner, and a background."""
    programs = {"T_ROB1": TURN, "T_ROB2": f"{TURN}{LATE}{TURN}", "T_BACK": "WaitTime 1;"}
    return ran(
        {name: f"PROC main()\n{text}\nENDPROC" for name, text in programs.items()},
        background=("T_BACK",),
    )


def test_moves_of_all_robots_are_numbered_through() -> None:
    run = three_tasks().run
    moves = [(move.index, move.task) for move in run.moves]
    assert moves == [(0, "T_ROB1"), (1, "T_ROB2"), (2, "T_ROB2"), (3, "T_ROB2")]
    assert [move.index for move in run.robot_of("t_rob2").moves] == [0, 1, 2]
    assert run.path_m == run.robots[0].path_m + run.robots[1].path_m


def test_an_event_of_a_move_has_its_number_among_all() -> None:
    run = three_tasks().run
    (corner,) = [event for event in run.events if event.kind is EventKind.CORNER]
    failed = run.moves[int(str(corner.details["move"]))]
    assert (failed.task, failed.end_s) == (corner.task, corner.time_s)
    assert failed.corner.value == "stop(corner path failure)"


def test_every_task_has_its_end() -> None:
    tasks = [(task.name, task.kind.value, task.end.value) for task in three_tasks().run.tasks]
    assert tasks == [
        ("T_ROB1", "normal", "ended"),
        ("T_ROB2", "normal", "ended"),
        ("T_BACK", "static", "ended"),
    ]


def test_nobody_takes_the_first_of_several_robots_by_mistake() -> None:
    run = three_tasks().run
    with pytest.raises(InputError, match="has 2 robots, those of T_ROB1, T_ROB2") as found:
        _ = run.only
    assert found.value.help == "take one of them, as `robot_of('T_ROB1')`"
    with pytest.raises(InputError, match="has 2 robots"):
        _ = run.trajectory
    with pytest.raises(InputError, match="no robot of a task `T_ROB3`") as missing:
        run.robot_of("T_ROB3")
    assert "T_ROB" in str(missing.value.help)


def test_a_run_of_one_robot_still_answers_for_it() -> None:
    run = ran_alone(f"MODULE cell\nPROC main()\n{TURN}\nENDPROC\nENDMODULE\n").run
    only = run.only
    assert run.moves is only.moves
    assert (run.task, run.robot, run.trajectory) == (only.task, only.robot, only.trajectory)
    assert (run.lines, run.failed_moves) == (only.lines, only.failed_moves)
    assert run.world_from_base is only.world_from_base
    assert run.sample(0.1).joints.tolist() == only.sample(0.1).joints.tolist()


@pytest.mark.parametrize(
    ("named", "program", "title"),
    [
        ("cell", ("a/x.mod",), "cell"),
        ("", ("a/x.mod",), "x.mod"),
        ("", ("a/x.mod", "b.mod", "c.mod"), "x.mod and 2 more"),
        ("cell", (), "cell"),
        ("", (), ""),
    ],
)
def test_a_run_is_called_as_its_user_called_it_or_by_its_files(
    named: str, program: tuple[str, ...], title: str
) -> None:
    assert replace(three_tasks().run, named=named, program=program).title == title
