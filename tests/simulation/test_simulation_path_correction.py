"""Programs whose path a sensor corrects: EGMActMove, EGMMoveL, EGMMoveC."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from simulation_program import Ran, ran
from simulation_sensor import Devices, Script, end_s, sensed

from rapidsim.controller.cell.description import CellIo, SignalDeclaration, SignalKind
from rapidsim.motion.guidance.feedback import Feedback, Guided
from rapidsim.motion.guidance.sensor import SensorAnswer

HEAD = r"""MODULE corrected
  VAR egmident id;
  VAR intnum late;
  CONST robtarget p1 := [[800,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2 := [[800,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p3 := [[900,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC prepare()
    EGMGetId id;
    EGMSetupUC ROB_1, id, "default", "UCdevice:" \PathCorr \APTR \CommTimeout:=0.5;
    MoveL p1, v500, fine, tool0;
    EGMActMove id, [[0,0,0],[1,0,0,0]] \SampleRate:=48;
  ENDPROC
"""
# The tool points down: with the path along +y of the base, y of the path is +x of the base, and z
# is -z of it.
FAST_S = 2e-3


def corrected(body: str, script: Script) -> tuple[Ran, Devices]:
    return sensed(f"{HEAD}  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n", script)


def by(y_mm: float, z_mm: float = 0.0, x_mm: float = 0.0) -> Script:
    return lambda told: SensorAnswer(correction=(x_mm, y_mm, z_mm))


def tcp_mm(it: Ran, times: np.ndarray) -> np.ndarray:
    (one,) = it.run.robots
    found: np.ndarray = 1e3 * one.trajectory.at(times).base_from_tcp.translation
    return found


@dataclass
class Course:
    """Where a TCP was, every 2 ms of a whole run."""

    it: Ran

    def __post_init__(self) -> None:
        self.times = np.arange(0.0, end_s(self.it), FAST_S)
        (one,) = self.it.run.robots
        self.joints = one.trajectory.at(self.times).joints
        self.places = tcp_mm(self.it, self.times)

    def has_no_jump(self) -> bool:
        """Whether no axis changes its speed by more than its acceleration allows, or nearly so."""
        speed = np.diff(self.joints, axis=0) / FAST_S
        return bool(np.abs(np.diff(speed, axis=0)).max() < 0.1)


def test_the_tcp_goes_beside_its_path_and_stays_there() -> None:
    it, devices = corrected(
        r"""    VAR robtarget there;
    prepare;
    EGMMoveL id, p2, v100, fine, tool0;
    TPWrite "state " \Num:=EGMGetState(id);
    there := CRobT();
    TPWrite ValToStr(there.trans);
    MoveL p1, v100, fine, tool0;
    there := CRobT();
    TPWrite ValToStr(there.trans);
    EGMReset id;""",
        by(5.0, -3.0, x_mm=40.0),
    )
    assert it.end == "ended"
    assert not it.run.diagnostics
    assert it.texts == ["state 1", "[805,100,603]", "[800,-100,600]"]
    heard = devices.sensor.heard
    assert np.allclose(np.diff([one.time_s for one in heard[:-1]]), 0.048, atol=1e-12)
    assert {one.guided for one in heard[:-1]} == {Guided.RUNNING}
    assert heard[-1].guided is Guided.STOPPED
    # What the sensor is told is where the robot is.
    told = np.array([one.position for one in heard])
    there = tcp_mm(it, np.array([one.time_s for one in heard]))
    assert np.allclose(told[:-1], there[:-1], atol=1e-6)
    # A fifth of a second away from it there is 1/e left.
    begun_s = heard[0].time_s
    left = 805.0 - tcp_mm(it, begun_s + np.array([0.5, 0.7]))[:, 0]
    assert left[1] / left[0] == pytest.approx(np.exp(-1.0), rel=0.05)
    assert Course(it).has_no_jump()


def test_a_sensor_that_wants_nothing_changes_nothing() -> None:
    body = """    prepare;
    EGMMoveL id, p2, v100, z10, tool0;
    EGMMoveL id, p3, v100, fine, tool0;"""
    it, _ = corrected(body, by(0.0))
    plain, _ = corrected(body.replace("EGMMoveL id,", "MoveL"), by(0.0))
    times = np.arange(0.0, end_s(plain), 0.05)
    assert end_s(it) == pytest.approx(end_s(plain), abs=0.06)
    assert np.allclose(tcp_mm(it, times), tcp_mm(plain, times), atol=1e-6)


def test_an_arc_is_left_by_as_much_everywhere() -> None:
    it, devices = corrected(
        r"""    prepare;
    EGMMoveC id, Offs(p1, 100, 100, 0), p2, v100, fine, tool0;""",
        by(4.0),
    )
    times = np.array([one.time_s for one in devices.sensor.heard[30:-1]])
    radius = np.linalg.norm(tcp_mm(it, times)[:, :2] - (800.0, 0.0), axis=1)
    assert np.allclose(radius, 104.0, atol=0.05)
    assert Course(it).has_no_jump()


def test_a_corner_and_stop_points_are_passed_beside_the_path() -> None:
    # The robot stops twice on its path, once where it turns; it never jumps.
    it, _ = corrected(
        r"""    prepare;
    EGMMoveL id, Offs(p1, 0, 100, 0), v100, fine, tool0;
    EGMMoveL id, p2, v100, z20, tool0;
    EGMMoveL id, p3, v100, fine, tool0;
    EGMMoveL id, Offs(p3, 0, -80, 0), v100, fine, tool0;""",
        by(5.0),
    )
    assert it.end == "ended"
    course = Course(it)
    assert course.has_no_jump()
    # Along +y it is 5 mm further out, along +x 5 mm further back, along -y 5 mm further in.
    assert tcp_mm(it, np.array([end_s(it)]))[0] == pytest.approx((895.0, 20.0, 600.0), abs=0.1)
    along_x = course.places[(course.places[:, 0] > 870) & (course.places[:, 0] < 890)]
    assert np.allclose(along_x[along_x[:, 1] > 50.0][:, 1], 95.0, atol=0.3)


def test_a_move_without_correction_comes_back_to_its_path() -> None:
    it, _ = corrected(
        r"""    prepare;
    EGMMoveL id, Offs(p1, 0, 80, 0), v50, z1, tool0;
    EGMMoveL id, p2, v50, fine, tool0 \NoCorr;""",
        by(5.0),
    )
    course = Course(it)
    halfway = course.places[np.argmin(np.abs(course.places[:, 1] + 22.0))]
    assert halfway[0] == pytest.approx(805.0, abs=0.05)
    assert course.places[-1] == pytest.approx((800.0, 100.0, 600.0), abs=0.05)


def test_the_configuration_at_the_end_is_where_the_path_leads_to() -> None:
    # A correction may lead into another configuration; a path without one is held to its target.
    turned = "VAR robtarget p; p := p2; p.robconf.cfx := 1; prepare;"
    it, _ = corrected(f"{turned}\nEGMMoveL id, p, v50, fine, tool0;", by(0.0))
    assert it.end == "ended"
    it, _ = corrected(f"{turned}\nMoveL p, v50, fine, tool0;", by(0.0))
    assert it.end == "error"


def test_silence_is_an_error_of_the_move() -> None:
    # It has said something for half a second; then the robot stops where it is, and another move
    # begins there.
    def until_half(told: Feedback) -> SensorAnswer | None:
        first.append(told.time_s)
        return SensorAnswer(correction=(0, 5, 0)) if told.time_s < first[0] + 0.5 else None

    first: list[float] = []
    it, _ = corrected(
        r"""    VAR robtarget there;
    prepare;
    EGMMoveL id, p2, v100, fine, tool0;
    TPWrite "behind it";
    there := CRobT();
    MoveL p1, v100, fine, tool0;
  ERROR
    IF ERRNO = ERR_UDPUC_COMM THEN
      there := CRobT();
      TPWrite "silent in state " \Num:=EGMGetState(id);
      TPWrite "half way " \Bool:=there.trans.y < 20;
      TRYNEXT;
    ENDIF""",
        until_half,
    )
    assert it.end == "ended"
    assert it.texts == ["silent in state 1", "half way TRUE", "behind it"]
    assert Course(it).has_no_jump()
    assert tcp_mm(it, np.array([end_s(it)]))[0] == pytest.approx((800.0, -100.0, 600.0), abs=0.01)


def test_who_never_answers_is_named() -> None:
    it, _ = corrected("    prepare;\n    EGMMoveL id, p2, v50, fine, tool0;", lambda told: None)
    assert it.end == "error"
    assert {code for code, _ in it.findings} == {"R101", "R150"}


def test_what_the_arm_cannot_reach_ends_the_program() -> None:
    it, _ = corrected("    prepare;\n    EGMMoveL id, p2, v10, fine, tool0;", by(0.0, 5000.0))
    assert it.end == "error"
    assert Course(it).has_no_jump()


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("EGMMoveL id, p2, v100, fine, tool0;", "EGMGetId makes it"),
        ("EGMGetId id;\n EGMMoveL id, p2, v100, fine, tool0;", "EGMSetupUC comes first"),
        (
            'EGMGetId id;\n EGMSetupUC ROB_1, id, "default", "x" \\PathCorr;\n'
            "EGMMoveL id, p2, v100, fine, tool0;",
            "EGMActMove comes first",
        ),
        (
            'EGMGetId id;\n EGMSetupUC ROB_1, id, "default", "x" \\Joint;\n'
            "EGMActMove id, [[0,0,0],[1,0,0,0]];",
            r"has not set this EGM identity up with \PathCorr",
        ),
        (
            "prepare;\n EGMActMove id, [[0,0,0],[1,0,0,0]] \\SampleRate:=20;",
            "SampleRate is 20 ms; it must be a multiple of 24 ms",
        ),
    ],
)
def test_what_is_missing_or_wrong_is_named(body: str, said: str) -> None:
    it, _ = corrected(body, by(0.0))
    assert it.end == "error"
    assert said in it.run.diagnostics[0].message


def test_a_program_that_forgets_its_stop_point_stops_before_the_next_move() -> None:
    it, _ = corrected(
        "    prepare;\n    EGMMoveL id, p2, v100, z10, tool0;\n    MoveL p3, v100, fine, tool0;",
        by(5.0),
    )
    assert it.end == "ended"
    course = Course(it)
    assert course.has_no_jump()
    assert np.abs(course.places - (805.0, 100.0, 600.0)).max(axis=1).min() < 0.05
    assert course.places[-1] == pytest.approx((900.0, 100.0, 600.0), abs=0.01)


def test_an_interrupt_may_stop_the_robot_and_forget_its_path() -> None:
    it, _ = corrected(
        r"""    CONNECT late WITH stop_here;
    prepare;
    ITimer \Single, 1, late;
    EGMMoveL id, p2, v100, fine, tool0;
    MoveL p1, v100, fine, tool0;
  ENDPROC
  TRAP stop_here
    StopMove \Quick;
    ClearPath;
    StartMove;
  ENDTRAP
  PROC never()""",
        by(5.0),
    )
    assert it.end == "ended"
    assert Course(it).has_no_jump()
    assert tcp_mm(it, np.array([end_s(it)]))[0] == pytest.approx((800.0, -100.0, 600.0), abs=0.01)


def test_an_output_corrects_a_path() -> None:
    it = ran(
        HEAD
        + r"""  PROC main()
    prepare;
    EGMSetupAO ROB_1, id, "default" \PathCorr \aoR2y:=aoAside;
    EGMActMove id, [[0,0,0],[1,0,0,0]];
    SetAO aoAside, 4;
    EGMMoveL id, p2, v50, fine, tool0;
  ENDPROC
ENDMODULE
""",
        io=CellIo(signals=(SignalDeclaration("aoAside", SignalKind.AO),)),
    )
    assert tcp_mm(it, np.array([end_s(it)]))[0] == pytest.approx((804.0, 100.0, 600.0), abs=0.01)
