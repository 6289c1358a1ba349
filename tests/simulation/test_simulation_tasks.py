"""Several tasks on one clock: order, shared data, signals, meetings, ends."""

from itertools import pairwise
from pathlib import Path

import pytest
from simulation_tasks import JOINTS, Ran, ran

from rapidsim.analysis.cell_names import CellNames
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.load_tasks import load_tasks
from rapidsim.module_files import TaskFiles
from rapidsim.station.cell_names import declared_names
from rapidsim.station.read import read_io
from rapidsim.station.station import Station

TASKS = 'PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];\nVAR syncident here;\nVAR syncident there;\n'


def main(*statements: str, data: str = "") -> str:
    return f"{data}\nPROC main()\n" + "\n".join(statements) + "\nENDPROC"


def both(first: str, second: str, **options: object) -> Ran:
    return ran({"T_ROB1": first, "T_ROB2": second}, **options)  # type: ignore[arg-type]


def test_the_task_with_the_earliest_time_runs_and_ties_go_in_the_order_of_tasks() -> None:
    it = both(
        main('TPWrite "a";', "WaitTime 1;", 'TPWrite "b";', "WaitTime 2;", 'TPWrite "c";'),
        main('TPWrite "x";', "WaitTime 1;", 'TPWrite "y";', "WaitTime 1;", 'TPWrite "z";'),
    )
    assert it.texts == [(0, "a"), (0, "x"), (1, "b"), (1, "y"), (2, "z"), (3, "c")]
    assert (it.end, it.run.time_s) == ("ended", 3.0)


def test_waitsynctask_lets_nobody_pass_before_all_are_there() -> None:
    it = both(
        main("WaitTime 1;", "WaitSyncTask here,both;", 'TPWrite "first";', data=TASKS),
        main("WaitTime 2.5;", "WaitSyncTask here,both;", 'TPWrite "second";', data=TASKS),
    )
    assert it.texts == [(2.5, "first"), (2.5, "second")]


def test_waitsynctask_with_inpos_waits_until_the_robot_stands() -> None:
    move = f"MoveAbsJ [[20,0,0,0,30,0],{JOINTS}],v100,z50,tool0;"
    free = both(
        main(move, "WaitSyncTask here,both;", 'TPWrite "on";', data=TASKS),
        main("WaitSyncTask here,both;", data=TASKS),
    )
    stands = both(
        main(move, r"WaitSyncTask \InPos,here,both;", 'TPWrite "on";', data=TASKS),
        main("WaitSyncTask here,both;", data=TASKS),
    )
    assert free.texts == [(0, "on")]
    assert stands.texts[0][0] == pytest.approx(stands.moves("T_ROB1")[0].end_s, abs=1e-3)
    assert stands.texts[0][0] > 2.0


def test_a_meeting_that_takes_too_long_is_an_error_a_handler_gets() -> None:
    handler = 'ERROR\nIF ERRNO=ERR_WAITSYNCTASK TPWrite "late";\nTRYNEXT;'
    it = both(
        main(r"WaitSyncTask here,both\TimeOut:=1.5;", handler, data=TASKS),
        main("WaitTime 5;", data=TASKS),
    )
    assert it.texts == [(1.5, "late")]
    assert it.end == "ended"


def test_who_gave_up_does_not_count_when_the_others_come() -> None:
    handler = "ERROR\nRETRY;"
    it = both(
        main(r"WaitSyncTask here,both\TimeOut:=1;", 'TPWrite "met";', handler, data=TASKS),
        main("WaitTime 2.5;", "WaitSyncTask here,both;", data=TASKS),
    )
    assert it.texts == [(2.5, "met")]


def test_a_persistent_of_one_name_is_one_datum_and_the_first_value_counts() -> None:
    it = both(
        main("WaitTime 1;", "count:=count+1;", data="PERS num count:=5;"),
        main(
            r'TPWrite "" \Num:=count;',
            "WaitTime 2;",
            r'TPWrite "" \Num:=count;',
            data="PERS num count:=7;",
        ),
    )
    assert it.texts == [(0, "5"), (2, "6")]


def test_an_array_and_a_record_are_shared_as_a_whole() -> None:
    data = "PERS num table{2,2}:=[[1,2],[3,4]];\nPERS pos here:=[1,2,3];"
    it = both(
        main("WaitTime 1;", "table{2,1}:=30;", "here.y:=20;", data=data),
        main("WaitTime 2;", "TPWrite ValToStr(table);", "TPWrite ValToStr(here);", data=data),
    )
    assert [text for _, text in it.texts] == ["[[1,2],[30,4]]", "[1,20,3]"]


@pytest.mark.parametrize("kept", ["TASK PERS", "LOCAL PERS"])
def test_task_and_local_persistents_stay_with_their_task(kept: str) -> None:
    it = both(
        main("count:=1;", data=f"{kept} num count:=5;"),
        main("WaitTime 1;", r'TPWrite "" \Num:=count;', data="PERS num count:=7;"),
    )
    assert it.texts == [(1, "7")]


def test_a_persistent_without_a_value_takes_that_of_the_other_task() -> None:
    it = both(
        main(r'TPWrite "" \Num:=count;', data="PERS num count;"),
        main("WaitTime 1;", data="PERS num count:=7;"),
    )
    assert it.texts == [(0, "7")]


def test_tasks_that_disagree_on_the_type_of_a_persistent_do_not_run() -> None:
    texts = [
        f"MODULE m{n}\n{main(data=data)}\nENDMODULE"
        for n, data in enumerate(("PERS num x:=1;", "PERS bool x:=TRUE;"), 1)
    ]
    files = [
        TaskFiles(f"T_ROB{n}", (SourceFile(f"{n}.mod", text, "utf-8"),))
        for n, text in enumerate(texts, 1)
    ]
    loaded = load_tasks(files)
    (found,) = [d for d in loaded.diagnostics if d.severity == "error"]
    assert not loaded.tasks
    assert found.violation.code == "N208"
    assert (found.span and found.span.file, found.related[0].span.file) == ("2.mod", "1.mod")


def test_a_handshake_by_persistents_is_seen_at_the_next_look() -> None:
    data = "PERS bool asked:=FALSE;\nPERS bool done:=FALSE;"
    it = both(
        main("WaitTime 1.05;", "asked:=TRUE;", "WaitUntil done;", 'TPWrite "go";', data=data),
        main("WaitUntil asked;", 'TPWrite "work";', "WaitTime 0.53;", "done:=TRUE;", data=data),
    )
    # WaitUntil looks every 0.1 s.
    assert it.texts == [(1.1, "work"), (1.65, "go")]


def test_a_handshake_by_signals_is_seen_at_once() -> None:
    it = both(
        main("WaitTime 1;", "SetDO ask,1;", "WaitDO done,1;", 'TPWrite "go";'),
        main("WaitDO ask,1;", 'TPWrite "work";', "WaitTime 0.55;", "SetDO done,1;"),
    )
    assert it.events == [
        (1.0, "T_ROB1", "ask = 1"),
        (1.0, "T_ROB2", "work"),
        (1.55, "T_ROB2", "done = 1"),
        (1.55, "T_ROB1", "go"),
    ]


def test_a_wait_with_a_time_limit_ends_with_what_another_task_does() -> None:
    it = both(
        main(r"WaitDO ask,1\MaxTime:=5;", 'TPWrite "seen";'),
        main(r"PulseDO\PLength:=0.3,ask;", "WaitTime 0.1;", "Reset ask;"),
    )
    assert it.texts == [(0, "seen")]


def test_a_delayed_output_of_a_task_that_has_ended_still_comes() -> None:
    it = both(main("WaitDO late,1;", 'TPWrite "there";'), main(r"SetDO\SDelay:=1.5,late,1;"))
    assert it.texts == [(1.5, "there")]


def test_an_interrupt_hears_the_other_task_at_its_instant_in_a_long_move() -> None:
    data = 'VAR intnum alarm;\nTRAP heard\nTPWrite "trap";\nENDTRAP'
    move = f"MoveAbsJ [[40,0,0,0,30,0],{JOINTS}],v100,z50,tool0;"
    stop = f"MoveAbsJ [[0,0,0,0,30,0],{JOINTS}],v100,fine,tool0;"
    it = both(
        main("CONNECT alarm WITH heard;", "ISignalDO ask,1,alarm;", move, stop, data=data),
        main("WaitTime 1.25;", "SetDO ask,1;"),
    )
    assert it.texts == [(1.25, "trap")]


def test_ipers_hears_what_the_other_task_writes() -> None:
    data = 'PERS num x:=0;\nVAR intnum alarm;\nTRAP heard\nTPWrite "trap";\nENDTRAP'
    it = both(
        main("CONNECT alarm WITH heard;", "IPers x,alarm;", "WaitTime 3;", data=data),
        main("WaitTime 1.25;", "x:=2;", data="PERS num x:=0;"),
    )
    assert it.texts == [(1.25, "trap")]


def test_ipers_hears_another_task_while_the_arm_drives_to_a_stop() -> None:
    data = 'PERS num x:=0;\nVAR intnum alarm;\nTRAP heard\nTPWrite "trap";\nENDTRAP'
    moves = (
        f"MoveAbsJ [[40,0,0,0,30,0],{JOINTS}],v100,z50,tool0;",
        f"MoveAbsJ [[0,0,0,0,30,0],{JOINTS}],v100,fine,tool0;",
    )
    it = both(
        main("CONNECT alarm WITH heard;", "IPers x,alarm;", *moves, data=data),
        main("FOR i FROM 1 TO 4 DO", "WaitTime 0.3;", "x:=i;", "ENDFOR", data="PERS num x:=0;"),
    )
    assert [text for _, text in it.texts] == ["trap"] * 4
    assert [time for time, _ in it.texts] == pytest.approx([0.3, 0.6, 0.9, 1.2], abs=0.01)


LOCKED = """
PERS bool lock:=FALSE;
PERS num inside:=0;
PROC main()
  FOR i FROM 1 TO 3 DO
    WaitUntil TestAndSet(lock);
    inside:=inside+1;
    TPWrite NAME \\Num:=inside;
    WaitTime 0.23;
    inside:=inside-1;
    lock:=FALSE;
    WaitTime 0.05;
  ENDFOR
ENDPROC
"""


@pytest.mark.parametrize("seconds", [50.0, 5000.0])
def test_who_waits_for_a_task_that_polls_what_is_unknown_waits_to_the_time_limit(
    seconds: float,
) -> None:
    it = both(
        main("WaitUntil ready;", 'TPWrite "never";', data="PERS bool ready:=FALSE;"),
        main("WHILE TRUE DO", "nobody;", "ENDWHILE", data="PERS bool ready:=FALSE;"),
        cell=CellNames(assumes=True),
        max_time_s=seconds,
    )
    assert (it.end, it.run.time_s, it.texts) == ("time_limit", seconds, [])
    (skipped,) = it.run.unsimulated
    assert skipped.count < 20_000


@pytest.mark.parametrize("seconds", [0.35, 90.0, 250.0, 1234.5])
def test_who_waits_for_long_sees_what_another_task_does_at_the_next_look(seconds: float) -> None:
    data = "PERS bool ready:=FALSE;"
    it = both(
        main("WaitUntil ready;", 'TPWrite "on";', data=data),
        main(f"WaitTime {seconds};", "ready:=TRUE;", "WHILE TRUE DO", "ENDWHILE", data=data),
        max_time_s=seconds + 1.0,
    )
    ((at_s, text),) = it.texts
    assert text == "on"
    assert 0.0 <= at_s - seconds <= 0.1 + 1e-6


def test_testandset_lets_one_task_in_at_a_time() -> None:
    it = both(LOCKED.replace("NAME", '"a"'), LOCKED.replace("NAME", '"b"'))
    assert len(it.texts) == 6
    assert {text for _, text in it.texts} == {"a1", "b1"}
    times = [time_s for time_s, _ in it.texts]
    assert all(after - before >= 0.23 for before, after in pairwise(times))


def test_waittestandset_waits_for_its_turn() -> None:
    wait = ("WaitTestAndSet lock;", 'TPWrite "in";', "WaitTime 0.55;", "lock:=FALSE;")
    it = both(
        main(*wait, data="PERS bool lock:=FALSE;"), main(*wait, data="PERS bool lock:=FALSE;")
    )
    assert it.texts == [(0, "in"), (0.6, "in")]


def test_tasks_that_wait_for_each_other_end_the_run_with_both_lines() -> None:
    it = both(
        main("WaitTime 1;", "WaitSyncTask here,both;", data=TASKS),
        main("WaitSyncTask there,both;", data=TASKS),
    )
    found = it.only("R106")
    assert it.end == "error"
    assert found.violation.message == (
        "the tasks wait for each other: T_ROB1 at T_ROB1.mod:8 in `WaitSyncTask here,both`, "
        "T_ROB2 at T_ROB2.mod:7 in `WaitSyncTask there,both`"
    )
    assert it.run.time_s == 1.0


def test_a_deadlock_by_persistents_and_signals_is_found_too() -> None:
    it = both(
        main("WaitUntil done;", data="PERS bool done:=FALSE;"),
        main("WaitDO go,1;", "done:=TRUE;", data="PERS bool done:=FALSE;"),
        max_time_s=500.0,
    )
    message = it.only("R106").violation.message
    assert "T_ROB1.mod:4 in `WaitUntil done`" in message
    assert "T_ROB2.mod:4 in `WaitDO go,1`" in message


def test_a_task_that_is_not_in_the_run_is_not_waited_for_and_the_run_says_so() -> None:
    lists = TASKS.replace('["T_ROB2"]', '["T_ROB7"]')
    it = ran({"T_ROB1": main("WaitSyncTask here,both;", 'TPWrite "on";', data=lists)})
    assert it.texts == [(0, "on")]
    (said,) = it.run.unsimulated
    assert said.treated_as == "without T_ROB7, which this run does not have"


def test_a_task_of_the_background_begins_again_and_ends_with_the_others() -> None:
    it = ran(
        {
            "T_ROB1": main("WaitTime 1;"),
            "T_BACK": main('TPWrite "tick";', "WaitTime 0.4;"),
        },
        background=("T_BACK",),
    )
    assert (it.end, it.run.time_s) == ("ended", 1.0)
    assert [round(time_s, 2) for time_s, _ in it.texts] == [0.0, 0.4, 0.8]


def test_an_empty_task_of_the_background_does_not_hang_the_run() -> None:
    it = ran({"T_ROB1": main("WaitTime 0.01;"), "T_BACK": main()}, background=("T_BACK",))
    assert it.run.time_s == pytest.approx(0.01)


def test_an_error_in_one_task_stops_the_robot_of_the_other_on_its_path() -> None:
    move = f"MoveAbsJ [[80,0,0,0,30,0],{JOINTS}],v100,fine,tool0;"
    it = both(main(move), main("WaitTime 1;", "x:=1/x;", data="VAR num x;"))
    (found,) = [d for d in it.run.diagnostics if d.severity == "error"]
    assert (it.end, found.span and found.span.file) == ("error", "T_ROB2.mod")
    assert 1.0 < it.run.robot_of("T_ROB1").trajectory.duration < 1.5
    assert 0.0 < it.run.robot_of("T_ROB1").trajectory.at([2.0]).joints[0, 0] < 0.5  # type: ignore[arg-type]


def test_endless_recursion_in_one_task_stops_the_run() -> None:
    it = both(main("again;") + "\nPROC again()\nagain;\nENDPROC", main("WaitTime 9;"))
    (found,) = [d for d in it.run.diagnostics if d.severity == "error"]
    assert "the stack overflowed in again" in found.violation.message
    assert it.run.time_s < 9.0


def test_the_time_limit_stops_all() -> None:
    loop = ("WHILE TRUE DO", "WaitTime 0.3;", "ENDWHILE")
    it = both(main(*loop), main(*loop), max_time_s=2.0)
    assert (it.end, it.run.time_s) == ("time_limit", 2.0)


def test_a_task_that_stops_itself_leaves_the_others_running() -> None:
    it = both(main("Stop;"), main("WaitTime 1;", 'TPWrite "later";'))
    assert (it.end, it.texts) == ("stopped", [(1, "later")])


def test_a_task_without_a_robot_cannot_move_and_says_what_to_do() -> None:
    move = f"MoveAbsJ [[20,0,0,0,30,0],{JOINTS}],v100,fine,tool0;"
    it = both(main("WaitTime 1;"), main(move), robots=("T_ROB1",))
    (found,) = [d for d in it.run.diagnostics if d.severity == "error"]
    assert "the task T_ROB2 has no robot" in found.violation.message


def test_a_task_knows_its_name_its_number_and_the_others() -> None:
    statements = (
        "TPWrite GetTaskName(\\TaskNo:=n \\MecTaskNo:=m) + ValToStr([n,m,MotionPlannerNo()]);",
        'TPWrite ValToStr(TaskRunRob()) + ValToStr(TaskIsActive("T_ROB1"));',
    )
    program = main(*statements, data="VAR num n;\nVAR num m;")
    it = both(
        main("WaitTime 1;"), program.replace("[n,m,MotionPlannerNo()]", "n"), robots=("T_ROB1",)
    )
    assert [text for _, text in it.texts] == ["T_ROB22", "FALSETRUE"]


def test_crobt_of_another_task_is_where_its_robot_is_at_that_instant() -> None:
    move = f"MoveAbsJ [[80,0,0,0,30,0],{JOINTS}],v100,fine,tool0;"
    ask = ("WaitTime 1.5;", 'j:=CJointT(\\TaskName:="T_ROB1");', "TPWrite ValToStr(j.robax.rax_1);")
    it = both(main(move), main(*ask, data="VAR jointtarget j;"), robots=("T_ROB1",))
    seen = it.run.robot_of("T_ROB1").trajectory.at([1.5]).joints[0, 0]  # type: ignore[arg-type]
    assert float(it.texts[0][1]) == pytest.approx(seen * 57.29577951, abs=1e-3)


BUSY = """
PERS num count:=0;
PERS bool flag:=FALSE;
VAR intnum alarm;
PROC main()
  CONNECT alarm WITH heard;
  ISignalDO tick,1,alarm;
  FOR i FROM 1 TO 6 DO
    MoveAbsJ [[10*(i MOD 2),0,0,0,30,0],AXES],v500,z10,tool0;
    count:=count+1;
    SetDO tick,i MOD 2;
    WHILE flag DO
      flag:=FALSE;
    ENDWHILE
    flag:=TRUE;
  ENDFOR
ENDPROC
TRAP heard
  TPWrite "trap" \\Num:=count;
ENDTRAP
""".replace("AXES", JOINTS)


def test_two_runs_are_equal_to_the_last_bit() -> None:
    runs = [both(BUSY, BUSY).run for _ in range(2)]
    events = [[(e.time_s, e.task, e.message) for e in run.events] for run in runs]
    joints = [[robot.trajectory.joints.tobytes() for robot in run.robots] for run in runs]
    assert len(events[0]) > 10
    assert events[0] == events[1]
    assert joints[0] == joints[1]


def test_a_tool_that_tasks_share_and_nobody_writes_lets_the_program_run_ahead() -> None:
    data = "PERS tooldata tool:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];"
    moves = [f"MoveAbsJ [[{k},0,0,0,30,0],{JOINTS}],v100,z10,tool;" for k in range(30)]
    stop = f"MoveAbsJ [[30,0,0,0,30,0],{JOINTS}],v100,fine,tool;"
    both_move = main(*moves, stop, data=data)
    it = both(both_move, both_move)
    assert [len(robot.moves) for robot in it.run.robots] == [31, 31]
    # One plan for all of the block: nobody had to know the time on the way.
    assert [len(robot.trajectory.pieces) for robot in it.run.robots] == [1, 1]


def test_a_busy_task_of_the_background_turns_a_thousand_times_a_second() -> None:
    loop = main("WHILE TRUE DO", "turns:=turns+1;", "ENDWHILE", data="PERS num turns:=0;")
    wait = main("WaitTime 5;", r'TPWrite "" \Num:=turns;', data="PERS num turns:=0;")
    it = ran({"T_ROB1": wait, "T_BACK": loop}, background=("T_BACK",))
    assert int(it.texts[0][1]) == pytest.approx(5000, abs=2)


def test_tasks_talk_over_a_socket() -> None:
    opened = ("SocketCreate s;", 'SocketBind s,"127.0.0.1",1025;', "SocketListen s;")
    answer = (r"SocketReceive c\Str:=got;", 'TPWrite "asked "+got;', "WaitTime 0.5;")
    server = main(
        *opened,
        "SocketAccept s,c;",
        *answer,
        'SocketSend c\\Str:="pong";',
        data="VAR socketdev s;\nVAR socketdev c;\nVAR string got;",
    )
    client = main(
        "WaitTime 1;",
        "SocketCreate c;",
        'SocketConnect c,"127.0.0.1",1025;',
        'SocketSend c\\Str:="ping";',
        r"SocketReceive c\Str:=got;",
        'TPWrite "told "+got;',
        data="VAR socketdev c;\nVAR string got;",
    )
    assert both(server, client).texts == [(1.0, "asked ping"), (1.5, "told pong")]


def test_a_task_without_a_robot_sees_the_arm_it_belongs_to() -> None:
    it = ran(
        {
            "T_ROB1": f"""PROC main()
              MoveAbsJ [[40,0,0,0,30,0],{JOINTS}],v5000,fine,tool0;
              WaitTime 3;
            ENDPROC""",
            "T_BACK": r"""PROC main()
              VAR jointtarget now;
              VAR robtarget place;
              now:=CJointT();
              TPWrite "at first "\Num:=Round(now.robax.rax_1);
              WaitTime 2;
              now:=CJointT();
              place:=CRobT(\Tool:=tool0\WObj:=wobj0);
              TPWrite "then "\Num:=Round(now.robax.rax_1);
              TPWrite "towards "\Num:=Round(ATan2(place.trans.y,place.trans.x));
              IF CJointT(\TaskName:="T_ROB1")=CJointT(\TaskRef:=T_ROB1Id) TPWrite "same";
              place.trans:=CPos(\Tool:=tool0\WObj:=wobj0);
              WaitTime 100;
            ENDPROC""",
        },
        background=("T_BACK",),
    )
    assert [text for _, text in it.texts] == ["at first 0", "then 40", "towards 40", "same"]
    assert not it.run.unsimulated


def test_system_outputs_show_the_state_of_the_controller(tmp_path: Path) -> None:
    file = tmp_path / "io.toml"
    file.write_text(
        """
        [signals]
        left_runs = { type = "do", system = "TaskExecuting", task = "T_ROB1" }
        motors = { type = "do", system = "MotOnState" }
        stopped = { type = "do", system = "EmStop" }
        failed = { type = "do", system = "Error" }
        """
    )
    it = ran(
        {
            "T_ROB1": "PROC main()\nWaitTime 1;\nENDPROC",
            "T_ROB2": """PROC main()
              IF motors=1 AND stopped=0 AND left_runs=1 AND failed=0 TPWrite "runs";
              WaitDO left_runs,0;
              TPWrite "alone";
            ENDPROC""",
        },
        cell=declared_names(Station(io=read_io(file))),
        io=read_io(file),
    )
    assert it.texts == [(0.0, "runs"), (1.0, "alone")]
    assert it.run.signal_starts == {"left_runs": 1, "motors": 1, "stopped": 0, "failed": 0}
