"""Move instructions, settings, displacement, robot state: what reaches the controller."""

from dataclasses import replace
from typing import Any

import pytest
from library_controller import CONF, HOME, JOINTS, RecordingController

from rapidsim.frames.quaternion import angle_between
from rapidsim.language import error_numbers as errors
from rapidsim.language.arc_data import ArcData, SeamData, WeldData
from rapidsim.language.data import (
    FINE,
    LOAD0,
    NO_EXTERNAL_AXES,
    TOOL0,
    UNUSED_AXIS,
    WOBJ0,
    ExtJoint,
    InPosData,
    JointTarget,
    Orient,
    Pos,
    Pose,
    RobTarget,
    Signal,
    SpeedData,
    StopPointData,
    ZoneData,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import (
    CirclePathMode,
    Interpolation,
    MotionSettings,
    SingularArea,
    StopTime,
)
from rapidsim.language.path_events import SetOutput, Trigger
from rapidsim.language.reference import Box
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.predefined import DATA

P10 = RobTarget(Pos(600.0, 100.0, 400.0), Orient(0.0, 0.0, 1.0, 0.0), CONF, NO_EXTERNAL_AXES)
P20 = RobTarget(Pos(700.0, 200.0, 400.0), Orient(0.0, 0.0, 1.0, 0.0), CONF, NO_EXTERNAL_AXES)
V100 = SpeedData(100.0, 500.0, 5000.0, 1000.0)
Z10 = ZoneData(False, 10.0, 15.0, 15.0, 1.5, 15.0, 1.5)
TOOL = Box(TOOL0)
GRIPPER = TOOL0._replace(tframe=Pose(Pos(0.0, 0.0, 100.0), Orient(1.0, 0.0, 0.0, 0.0)))
TABLE = WOBJ0._replace(uframe=Pose(Pos(500.0, 0.0, 0.0), Orient(1.0, 0.0, 0.0, 0.0)))
QUARTER = ROUTINES["orientzyx"].body(90.0, 0.0, 0.0)
DO_GUN = Signal("doGun")


def moved(name: str, *arguments: Any, **options: Any) -> Any:
    controller = RecordingController()
    controller.call(name, *arguments, **options)
    assert not controller.unsimulated
    (move,) = controller.moves
    return move


def test_move_l_passes_its_arguments_on() -> None:
    move = moved("MoveL", P10, V100, Z10, Box(GRIPPER), wobj=Box(TABLE))
    assert (move.instruction, move.interpolation) == ("MoveL", Interpolation.LINE)
    assert (move.to, move.speed, move.zone) == (P10, V100, Z10)
    assert (move.tool, move.wobj) == (GRIPPER, TABLE)
    assert (move.circle_point, move.duration_s, move.concurrent) == (None, None, False)


def test_without_a_work_object_it_is_wobj0() -> None:
    assert moved("MoveJ", P10, V100, FINE, TOOL).wobj == WOBJ0


def test_each_instruction_has_its_interpolation() -> None:
    assert moved("MoveJ", P10, V100, FINE, TOOL).interpolation is Interpolation.JOINT
    assert moved("MoveAbsJ", JOINTS, V100, FINE, TOOL).interpolation is Interpolation.AXES
    arc = moved("MoveC", P20, V100, FINE, TOOL, cir_point=P10)
    assert arc.interpolation is Interpolation.CIRCLE
    assert (arc.circle_point, arc.to) == (P10, P20)


def test_options_replace_speed_and_zone() -> None:
    move = moved("MoveL", P10, V100, Z10, TOOL, v=250.0, z=20.0, conc=True)
    assert move.speed == V100._replace(v_tcp=250.0)
    assert move.zone == ZoneData(False, 20.0, 30.0, 30.0, 3.0, 30.0, 3.0)
    assert move.concurrent
    assert moved("MoveL", P10, V100, Z10, TOOL, t=2.5).duration_s == 2.5


# Those that a sensor corrects say first which: `EGMid`.
TO_A_POSE = [
    row.name
    for row in ROUTINES.values()
    if row.simulated
    and {p.name for p in row.signature.parameters} & {"ToPoint", "EGMid"} == {"ToPoint"}
]
WAYS = {"J": Interpolation.JOINT, "L": Interpolation.LINE, "C": Interpolation.CIRCLE}


def test_all_moves_to_a_pose_are_known() -> None:
    assert sorted(TO_A_POSE) == sorted(
        [f"Move{way}{more}" for way in "JLC" for more in ("", "DO", "AO", "GO", "Sync")]
        + ["TriggJ", "TriggL", "TriggC", "TriggJIOs", "TriggLIOs", "SearchL", "SearchC"]
    )


@pytest.mark.parametrize("name", TO_A_POSE)
def test_all_moves_to_a_pose_take_the_same_arguments_alike(name: str) -> None:
    given: dict[str, object] = {
        "cir_point": P20,
        "to_point": P10,
        "speed": V100,
        "zone": Z10,
        "tool": Box(GRIPPER),
        "signal": Box(DO_GUN),
        "search_point": Box(P20),
        "trigg_1": Box(Trigger(SetOutput("doGun", 1.0))),
        "value": 1.0,
        "proc_name": "glue",
        "wobj": Box(TABLE),
        "t": 2.5,
        "conc": True,
        "tload": Box(LOAD0),
        "corr": True,
    }
    controller = RecordingController()
    parameters = [p for p in ROUTINES[name.lower()].signature.parameters if p.python in given]
    controller.call(
        name,
        *(given[p.python] for p in parameters if not p.by_keyword),
        **{p.python: given[p.python] for p in parameters if p.by_keyword},
    )
    (move,) = controller.moves
    way = WAYS[name.removeprefix("Move").removeprefix("Trigg").removeprefix("Search")[0]]
    names = {p.python for p in parameters}
    assert (move.instruction, move.interpolation) == (name, way)
    assert (move.to, move.speed, move.duration_s) == (P10, V100, 2.5)
    assert move.zone == (Z10 if "zone" in names else FINE)
    assert (move.tool, move.wobj, move.concurrent) == (GRIPPER, TABLE, "conc" in names)
    assert move.circle_point == (P20 if way is Interpolation.CIRCLE else None)
    # No correction generator is connected.
    assert [what for what, _ in controller.unsimulated] == [rf"{name} \TLoad"]
    assert ("corr" in names) is (
        not name.endswith(("DO", "AO", "GO", "Sync")) and "J" not in name[:6]
    )


@pytest.mark.parametrize(
    ("name", "options", "reported"),
    [
        ("MoveL", {"tload": Box(LOAD0)}, r"MoveL \TLoad"),
        ("MoveJ", {"id_": None, "tload": Box(LOAD0)}, r"MoveJ \TLoad"),
    ],
)
def test_what_is_not_heeded_is_reported(
    name: str, options: dict[str, object], reported: str
) -> None:
    controller = RecordingController()
    controller.call(name, P10, V100, Z10, TOOL, **options)
    assert controller.unsimulated == [(reported, "ignored")]
    assert len(controller.moves) == 1


def test_stop_point_data_make_a_stop_point() -> None:
    controller = RecordingController()
    criteria = StopPointData(1.0, True, InPosData(50.0, 50.0, 0.0, 2.0), 0.0, 0.0, "", 0.0, 0.0)
    controller.call("MoveL", P10, V100, Z10, TOOL, inpos=criteria)
    assert controller.moves[0].zone.finep
    assert controller.moves[0].stop == StopTime(0.0, True)
    pause = StopPointData(2.0, False, InPosData(0.0, 0.0, 0.0, 0.0), 0.5, 0.0, "", 0.0, 0.0)
    controller.call("MoveL", P10, V100, Z10, TOOL, inpos=pause)
    assert controller.moves[1].stop == StopTime(0.5, False)
    assert not controller.unsimulated
    controller.call("MoveL", P10, V100, Z10, TOOL, inpos=pause._replace(type=3.0))
    assert controller.unsimulated == [(r"\Inpos that follows a conveyor", "a stop point")]


def test_settings() -> None:
    controller = RecordingController()
    controller.call("VelSet", 50.0, 800.0)
    controller.call("AccSet", 5.0, 5.0, fine_point_ramp=50.0)
    controller.call("ConfJ", off=True)
    controller.call("ConfL", off=True)
    settings = controller.settings
    assert (settings.speed_override_percent, settings.max_speed_mm_s) == (50.0, 800.0)
    assert (settings.acceleration_percent, settings.ramp_percent) == (20.0, 10.0)
    assert settings.fine_ramp_percent == 50.0
    assert (settings.conf_j, settings.conf_l) == (False, False)
    controller.call("ConfJ", on=True)
    controller.call("ConfL")
    assert (controller.settings.conf_j, controller.settings.conf_l) == (True, True)
    controller.call("AccSet", 100.0, 100.0)
    assert controller.settings.fine_ramp_percent == 100.0
    assert not controller.unsimulated


@pytest.mark.parametrize(
    ("options", "area"),
    [
        ({}, SingularArea.OFF),
        ({"off": True}, SingularArea.OFF),
        ({"wrist": True}, SingularArea.WRIST),
        ({"lock_axis4": True}, SingularArea.LOCK_AXIS_4),
    ],
)
def test_singularity_modes(options: dict[str, bool], area: SingularArea) -> None:
    controller = RecordingController()
    controller.call("SingArea", **options)
    assert controller.settings.singular_area is area


@pytest.mark.parametrize(
    ("options", "mode"),
    [
        ({}, CirclePathMode.PATH_FRAME),
        ({"object_frame": True}, CirclePathMode.OBJECT_FRAME),
        ({"cir_point_ori": True}, CirclePathMode.CIR_POINT_ORI),
        ({"wrist56": True}, CirclePathMode.WRIST56),
    ],
)
def test_circle_modes(options: dict[str, bool], mode: CirclePathMode) -> None:
    controller = RecordingController()
    controller.call("CirPathMode", **options)
    assert controller.settings.circle_path is mode


def test_acceleration_limits() -> None:
    controller = RecordingController()
    controller.call("PathAccLim", True, True, acc_max=4.0, decel_max=3.0)
    controller.call("WorldAccLim", on=2.0)
    limits = controller.settings
    assert (limits.tcp_acceleration_m_s2, limits.tcp_deceleration_m_s2) == (4.0, 3.0)
    assert [name for name, _ in controller.unsimulated] == ["PathAccLim with two different limits"]
    assert limits.world_acceleration_m_s2 == 2.0
    controller.call("PathAccLim", False, False)
    controller.call("WorldAccLim", off=True)
    assert controller.settings == MotionSettings()
    with pytest.raises(RapidError, match=r"AccMax needs at least 0\.1 m/s2, not 0\.05") as caught:
        controller.call("PathAccLim", True, False, acc_max=0.05)
    assert caught.value.errno == errors.ERR_ACC_TOO_LOW


def test_units_are_switched_by_name() -> None:
    controller = RecordingController()
    controller.place = replace(controller.place, arguments={"mechunit": "Track"})
    controller.call("DeactUnit", Box(None))
    assert controller.settings.inactive_units == {"track"}
    assert controller.call("IsMechUnitActive", Box(None)) is False
    controller.call("ActUnit", Box(None))
    assert controller.call("IsMechUnitActive", Box(None)) is True


def test_move_ext_j_takes_offsets_only_when_asked() -> None:
    controller = RecordingController()
    to = JOINTS._replace(extax=NO_EXTERNAL_AXES._replace(eax_a=100.0))
    controller.call("EOffsSet", NO_EXTERNAL_AXES._replace(eax_a=10.0))
    controller.call("MoveExtJ", to, V100, FINE)
    controller.call("MoveExtJ", to, V100, FINE, use_eoffs=True)
    assert [move.to.extax.eax_a for move in controller.moves] == [100.0, 110.0]
    assert controller.moves[0].interpolation is Interpolation.EXTERNAL_AXES


def test_displacement_moves_targets_until_it_is_off() -> None:
    controller = RecordingController()
    controller.call("PDispSet", Pose(Pos(0.0, 0.0, 50.0), QUARTER))
    controller.call("MoveL", P10, V100, FINE, TOOL)
    controller.call("MoveAbsJ", JOINTS, V100, FINE, TOOL)
    controller.call("PDispOff")
    controller.call("MoveL", P10, V100, FINE, TOOL)
    displaced, axes, plain = controller.moves
    assert displaced.to[0] == pytest.approx((-100.0, 600.0, 450.0), abs=1e-3)
    assert axes.to == JOINTS
    assert plain.to == P10


def test_displacement_from_where_the_robot_is() -> None:
    controller = RecordingController()
    controller.call("PDispOn", P10, TOOL)
    displacement = controller.settings.displacement
    assert displacement is not None
    assert displacement.trans == Pos(-100.0, -100.0, 400.0)
    controller.call("PDispOn", P10, TOOL, exe_p=P20)
    controller.call("MoveL", P10, V100, FINE, TOOL)
    target = controller.moves[0].to
    assert isinstance(target, RobTarget)
    assert target.trans == P20.trans


def test_displacement_with_rotation_takes_one_target_to_the_other() -> None:
    controller = RecordingController()
    turned = P20._replace(rot=QUARTER)
    controller.call("PDispOn", P10, TOOL, rot=True, exe_p=turned)
    controller.call("MoveJ", P10, V100, FINE, TOOL)
    target = controller.moves[0].to
    assert isinstance(target, RobTarget)
    assert target.trans == pytest.approx(turned.trans, abs=1e-3)
    assert angle_between(target.rot, turned.rot) < 1e-6


def test_positions_are_read_as_the_program_would_give_them() -> None:
    controller = RecordingController()
    assert controller.call("CRobT") == HOME
    assert controller.call("CPos") == HOME.trans
    controller.call("PDispSet", Pose(Pos(10.0, 20.0, 30.0), QUARTER))
    controller.call("MoveL", controller.call("CRobT"), V100, FINE, TOOL)
    target = controller.moves[0].to
    assert isinstance(target, RobTarget)
    assert target.trans == pytest.approx(HOME.trans, abs=1e-3)
    assert controller.call("ORobT", controller.call("CRobT")).trans == pytest.approx(
        HOME.trans, abs=1e-3
    )


def test_axis_offsets_leave_unused_axes_alone() -> None:
    controller = RecordingController()
    unused = (UNUSED_AXIS,) * 5
    controller.call("EOffsSet", ExtJoint(100.0, *(0.0,) * 5))
    on_track = JointTarget(JOINTS.robax, ExtJoint(500.0, *unused))
    controller.call("MoveAbsJ", on_track, V100, FINE, TOOL)
    controller.call("MoveAbsJ", on_track, V100, FINE, TOOL, no_eoffs=True)
    controller.call("EOffsOff")
    controller.call("MoveAbsJ", on_track, V100, FINE, TOOL)
    axes = [move.to.extax for move in controller.moves]
    assert axes == [ExtJoint(x, *unused) for x in (600.0, 500.0, 500.0)]


def test_kinematics_of_targets() -> None:
    controller = RecordingController()
    assert controller.call("CalcJointT", P10, TOOL) == JOINTS
    assert controller.call("CalcRobT", JOINTS, TOOL) == HOME
    controller.in_reach = False
    with pytest.raises(RapidError) as caught:
        controller.call("CalcJointT", P10, TOOL)
    assert caught.value.errno == errors.ERR_OUTSIDE_REACH
    number: Box[float] = Box(0.0)
    controller.call("CalcJointT", P10, TOOL, error_number=number)
    assert number.value == errors.ERR_OUTSIDE_REACH


def test_the_arms_of_other_tasks_are_asked_for() -> None:
    controller = RecordingController()
    assert controller.call("CJointT", task_name="T_ROB2") == JOINTS
    assert not controller.unsimulated
    assert controller.call("CJointT", task_ref=Box(None)) == JOINTS
    assert not controller.unsimulated


def test_the_highest_speeds_are_those_of_vmax() -> None:
    vmax = DATA["vmax"].value
    assert isinstance(vmax, SpeedData)
    controller = RecordingController()
    assert controller.call("MaxRobSpeed") == vmax.v_tcp
    assert controller.call("MaxRobReorientSpeed") == vmax.v_ori
    assert controller.call("MaxExtLinearSpeed") == vmax.v_leax
    assert controller.call("MaxExtReorientSpeed") == vmax.v_reax


def test_searches_and_moves_with_outputs_give_the_controller_all_it_needs() -> None:
    controller = RecordingController()
    found: Box[RobTarget] = Box(P10)
    controller.call("SearchL", Box(DO_GUN), found, P10, V100, TOOL, p_stop=True)
    controller.call("MoveLDO", P20, V100, Z10, TOOL, Box(DO_GUN), 1.0, wobj=Box(TABLE))
    assert found.value == HOME
    search, move = controller.moves
    assert (search.instruction, search.zone, search.to) == ("SearchL", FINE, P10)
    assert (move.zone, move.wobj, move.to) == (Z10, TABLE, P20)
    assert controller.log == ["search doGun, rising, stop on the path"]
    assert controller.triggers == (Trigger(SetOutput("doGun", 1.0)),)
    assert not controller.unsimulated


def test_arc_welding_moves_along_the_seam() -> None:
    controller = RecordingController()
    arc = ArcData(*(0.0,) * 9)
    seam = SeamData(0.5, 0.3, arc, 0.2, 0, 0, 0, 0, arc, 0.1, 0, arc, 0, 0, arc, 0.4)
    weld = WeldData(10.0, 0.0, arc, arc)
    controller.call("ArcLStart", P10, V100, seam, weld, Z10, TOOL, wobj=Box(TABLE), seam_name="s")
    controller.call("ArcC", P10, V100, seam, weld, Z10, TOOL, cir_point=P20)
    controller.call("ArcLEnd", P20, V100, seam, weld, Z10, TOOL, track=())
    start, on, end = controller.moves
    assert (start.instruction, start.to, start.wobj) == ("ArcLStart", P10, TABLE)
    assert [one.speed.v_tcp for one in controller.moves] == [100.0, 10.0, 10.0]
    assert [one.zone.finep for one in controller.moves] == [True, False, True]
    assert on.circle_point == P20
    assert end.to == P20
    assert controller.log == ["wait 0.5 in position", "wait 0.5 in position"]
    assert [name for name, _ in controller.unsimulated] == [
        *("ArcLStart", "ArcC", "ArcLEnd"),
        r"ArcLEnd \Track",
    ]
