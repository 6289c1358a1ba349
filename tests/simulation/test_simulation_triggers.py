"""Places on the path: triggers, ramps, procedures, checks; stopping there and clearing the path."""

import numpy as np
import pytest
from simulation_program import Ran, ran

from rapidsim.controller.journal.events import EventKind
from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.timing.axis_limits import limits_of

FRAME = """MODULE cell
  CONST robtarget a:=[[800,-300,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget c:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata one;
  VAR triggdata two;
  VAR triggdata many{25};
  VAR intnum here;
  PERS bool off:=FALSE;
  PROC main()
    MoveJ a,v500,fine,tool0;
"""


def run(statements: str, more: str = "") -> Ran:
    return ran(
        f"{FRAME}{statements}\nENDPROC\n{more}\nENDMODULE\n", max_time_s=60.0, model=MODELS["1"]
    )


def place_of(done: Ran, message: str) -> np.ndarray:
    """Where the TCP is [mm] when something happens."""
    (event,) = [e for e in done.run.events if e.message == message]
    sample = done.run.only.sample(event.time_s)
    found: np.ndarray = 1e3 * done.run.only.robot.forward(sample.joints).translation[0]
    return found


def time_of(done: Ran, message: str) -> float:
    (event,) = [e for e in done.run.events if e.message == message]
    return event.time_s


@pytest.mark.parametrize(
    ("definition", "y"),
    [
        (r"TriggIO one,50\DOp:=doA,1;", -50.0),
        (r"TriggIO one,50\Start\DOp:=doA,1;", -250.0),
        (r"TriggIO one,900\DOp:=doA,1;", -300.0),
        (r"TriggIO one,0\DOp:=doA,1;", 0.0),
        (r"TriggEquip one,100,0\DOp:=doA,1;", -100.0),
    ],
)
@pytest.mark.parametrize("zone", ["fine", "z1"])
def test_a_trigger_is_at_its_place(definition: str, y: float, zone: str) -> None:
    done = run(f"{definition}\nTriggL b,v200,one,{zone},tool0;\nMoveL c,v200,fine,tool0;")
    assert place_of(done, "doA = 1") == pytest.approx([800.0, y, 600.0], abs=0.5)
    # The circle of the zone is cut; away from it the place is exact.
    if y < -1.0:
        assert place_of(done, "doA = 1")[1] == pytest.approx(y, abs=1e-5)


def test_lags_delays_and_times_are_times_before_and_after_a_place() -> None:
    done = run(
        r"""
        TriggIO one,100\DOp:=doPlace,1;
        TriggEquip two,100,0.05\DOp:=doEarly,1;
        TriggIO many{1},100\DOp:=doLate,1\DODelay:=0.05;
        TriggIO many{2},0.2\Time\DOp:=doBefore,1;
        TriggL b,v200,one\T2:=two\T3:=many{1}\T4:=many{2},fine,tool0;
        Set doThere;
        """
    )
    place_s = time_of(done, "doPlace = 1")
    assert time_of(done, "doEarly = 1") == pytest.approx(place_s - 0.05)
    assert time_of(done, "doLate = 1") == pytest.approx(place_s + 0.05)
    assert time_of(done, "doBefore = 1") == pytest.approx(
        time_of(done, "doThere = 1") - 0.2, abs=1e-3
    )


def test_an_array_of_triggers_and_one_that_is_inhibited() -> None:
    done = run(
        r"""
        off:=TRUE;
        FOR i FROM 1 TO 3 DO
          TriggIO many{i},50*i\GOp:=goCount,i;
        ENDFOR
        TriggIO many{4},10\DOp:=doNever,1\Inhib:=off;
        TriggL b,v200,many,fine,tool0;
        TPWrite "count "\Num:=GOutput(goCount);
        """
    )
    counts = [e.message for e in done.run.events if e.kind is EventKind.SIGNAL]
    assert counts == ["goCount = 3", "goCount = 2", "goCount = 1"]
    assert done.texts == ["count 1"]


def test_an_interrupt_at_a_place_stops_the_robot_there_and_the_rest_is_forgotten() -> None:
    done = run(
        r"""
        CONNECT here WITH stop_here;
        TriggInt one,100,here;
        TriggL b,v200,one,fine,tool0;
        TPWrite "cleared "\Bool:=stopped.y<-80 AND stopped.y>-100;
        MoveL a,v200,fine,tool0;
        TPWrite "home "\Bool:=Distance(CPos(),a.trans)<0.001;
        """,
        r"""
        VAR pos stopped;
        TRAP stop_here
          StopMove\Quick;
          stopped:=CPos();
          ClearPath;
          StartMove;
        ENDTRAP
        """,
    )
    assert done.texts == ["cleared TRUE", "home TRUE"]
    assert place_of(done, "trap stop_here")[1] == pytest.approx(-100.0, abs=1e-5)


def test_moves_ahead_of_the_robot_are_forgotten_with_the_path() -> None:
    done = run(
        r"""
        CONNECT here WITH again;
        ITimer\Single,1.5,here;
        MoveL b,v200,z10,tool0;
        MoveL c,v200,z10,tool0;
        MoveL b,v200,z10,tool0;
        WaitTime\InPos,0;
        TPWrite "done";
        MoveL a,v200,fine,tool0;
        """,
        "TRAP again\nStopMove\\Quick;\nClearPath;\nStartMove;\nENDTRAP",
    )
    assert done.texts == ["done"]
    assert time_of(done, "done") == pytest.approx(time_of(done, "trap again") + 0.1, abs=0.02)
    # What the robot made of its way to b, and the way back from there.
    assert [move.move.instruction for move in done.run.moves] == ["MoveJ", "MoveL", "MoveL"]
    assert place_of(done, "done")[0] == pytest.approx(800.0, abs=1e-6)


def test_a_signal_is_checked_at_a_place_and_stops_the_robot() -> None:
    done = run(
        r"""
        CONNECT here WITH not_ready;
        TriggCheckIO one,100,diReady,EQ,1\StopMove,here;
        TriggL b,v200,one,fine,tool0;
        TPWrite "there "\Bool:=Distance(CPos(),b.trans)<0.001;
        """,
        'TRAP not_ready\nTPWrite "not ready";\nWaitTime 1;\nStartMove;\nENDTRAP',
    )
    assert done.texts == ["not ready", "there TRUE"]
    assert place_of(done, "not ready")[1] == pytest.approx(-100.0, abs=1e-5)
    # One second of waiting, and braking and starting again.
    assert time_of(done, "there TRUE") - time_of(done, "not ready") == pytest.approx(1.6, abs=0.1)


def test_a_ramp_goes_evenly_over_its_way() -> None:
    done = run(
        r"""
        TriggRampAO one,200,0,aoFlow,10,100;
        TriggL b,v200,one,fine,tool0;
        """
    )
    flow = [e for e in done.run.events if e.kind is EventKind.SIGNAL]
    times = np.array([e.time_s for e in flow])
    values = np.array([float(str(e.details["value"])) for e in flow])
    y = 1e3 * done.run.only.robot.forward(done.run.only.sample(times).joints).translation[:, 1]
    assert values[-1] == 10.0
    assert values == pytest.approx(np.clip((y + 200.0) / 10.0, 0.0, 10.0), abs=1e-3)


def test_a_procedure_runs_in_the_middle_of_the_corner() -> None:
    done = run(
        r"""
        MoveLSync b,v200,z50,tool0,"passing";
        MoveL c,v200,fine,tool0;
        """,
        """
        PROC passing()
          VAR pos p;
          p:=CPos();
          TPWrite "passing "\\Bool:=p.y>-30 AND p.z<630;
        ENDPROC
        """,
    )
    assert done.texts == ["passing TRUE"]
    _, y, z = place_of(done, "procedure passing")
    assert abs(y) == pytest.approx(z - 600.0, abs=0.01), "it is the middle"


@pytest.mark.parametrize(
    ("statement", "error"),
    [
        ("RestoPath;", "ERR_PATH"),
        ("MoveL b,v200,z50,tool0;\nStorePath;", "ERR_PATH"),
        ("MoveL b,v200,z50,tool0;\nClearPath;", "ERR_PATH"),
        ("TriggL b,v200,two,fine,tool0;", "ERR_ARGVALERR"),
        ("WZFree zone;", "ERR_ARGVALERR"),
    ],
)
def test_misuse_is_an_error_that_a_program_can_catch(statement: str, error: str) -> None:
    handler = f'ERROR\nTPWrite "caught "\\Bool:=ERRNO={error};\nTRYNEXT;'
    done = run(f"{statement}\n{handler}", "VAR wztemporary zone;")
    assert done.texts[:1] == ["caught TRUE"]


def test_braking_stays_on_the_line_and_within_the_axes_accelerations() -> None:
    model = MotionModel(filter_time=0.0, own_accelerations=False)
    text = f"{FRAME}CONNECT here WITH halt;\nITimer\\Single,0.2,here;\nMoveL b,v1000,fine,tool0;\n"
    text += "ENDPROC\nTRAP halt\nStopMove\\Quick;\nStartMove;\nENDTRAP\nENDMODULE\n"
    run = ran(text, model=model).run
    start = next(e.time_s for e in run.events if e.kind is EventKind.INTERRUPT)
    times = np.arange(start + 0.002, start + 0.4, 1e-3)
    samples = run.only.sample(times)
    tcp = 1e3 * run.only.robot.forward(samples.joints).translation
    assert np.max(np.abs(tcp[:, [0, 2]] - [800.0, 600.0])) < 1e-3
    standing = np.flatnonzero(samples.tcp_speed < 1e-6)
    assert len(standing), "it stops"
    braking = samples.joints[: standing[0]]
    acceleration = np.abs(np.diff(braking, 2, axis=0)) / 1e-6
    used = acceleration / limits_of(run.only.robot, model).max_acceleration
    assert 0.9 < np.max(used) < 1.01, "some axis brakes as fast as it can, and none faster"


@pytest.mark.parametrize("thickness_mm", [40.0, 3.0])
def test_a_thin_zone_is_seen_at_full_speed(thickness_mm: float) -> None:
    """At v2500 the TCP is through 3 mm in 1.2 ms."""
    done = run(
        rf"""
        WZBoxDef\Inside,wall,[700,-150,500],[900,{thickness_mm - 150.0},700];
        WZDOSet\Temp,lamp\Inside,wall,doLamp,1;
        MoveL b,v2500,fine,tool0;
        """,
        "VAR shapedata wall;\nVAR wztemporary lamp;",
    )
    assert [e.message for e in done.run.events] == ["doLamp = 1", "doLamp = 0"]
    assert place_of(done, "doLamp = 1")[1] == pytest.approx(-150.0, abs=1e-5)
    assert place_of(done, "doLamp = 0")[1] == pytest.approx(thickness_mm - 150.0, abs=1e-5)


def test_an_output_follows_the_speed_and_ends_at_nothing() -> None:
    done = run("TriggSpeed one,100,0.05,aoFlow,2;\nTriggL b,v200,one,fine,tool0;")
    written = [e.details["value"] for e in done.run.events if e.kind is EventKind.SIGNAL]
    flow = [float(str(value)) for value in written]
    assert max(flow) == pytest.approx(400.0, rel=1e-3)
    assert flow[-1] == 0.0
    assert not done.run.unsimulated
