"""Tracks, positioners, stationary tools, a robot off the world's origin: runs and their frames."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from math import radians
from pathlib import Path

import numpy as np
import pytest
from simulation_program import Ran, ran

from rapidsim.controller.cell.description import CellIo, Stimulus
from rapidsim.files import InputError
from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.targets import world_from_base_at
from rapidsim.motion.model import MODELS
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.report.run.figures import figures
from rapidsim.report.run.json_report import RunFiles, run_json
from rapidsim.simulation.results.active_limits import limits_of_moves
from rapidsim.station.read import read_station

TRACK = ExternalAxis(
    "TRACK", "a", True, -0.5, 3.0, 1.0, 4.0, carries="robot", direction=(0.0, 1.0, 0.0)
)
TABLE = ExternalAxis(
    "TABLE",
    "b",
    False,
    radians(-180.0),
    radians(180.0),
    radians(90.0),
    radians(360.0),
    carries="wobj",
    world_from_user=Transform(np.eye(3), np.array([0.9, 0.1, 0.4])),
)
QUARTER = Transform(rotation_from_vector(np.array([0.0, 0.0, np.pi / 2])), np.array([0, 0, 0.5]))

HEAD = r"""MODULE cell
  PERS wobjdata turntable:=[FALSE,FALSE,"TABLE",[[7,7,7],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
"""


def program(*lines: str, data: str = "") -> str:
    body = "\n".join(f"    {line}" for line in lines)
    free = "    ConfJ \\Off;\n    ConfL \\Off;"
    return f"{HEAD}{data}\n  PROC main()\n{free}\n{body}\n  ENDPROC\nENDMODULE"


def target(name: str, x: float, y: float, z: float, axes: str, rot: str = "[0,0,1,0]") -> str:
    return f"  CONST robtarget {name}:=[[{x},{y},{z}],{rot},[0,0,0,0],[{axes}]];\n"


NONE = "9E9,9E9,9E9,9E9,9E9,9E9"


def samples(run: Ran, move: int) -> Samples:
    done = run.run.moves[move]
    return run.run.only.trajectory.at(np.linspace(done.start_s, done.end_s, 60))


def line_error(points: Array) -> float:
    """How far (k, 3) points are off the line from the first to the last."""
    along = (points[-1] - points[0]) / np.linalg.norm(points[-1] - points[0])
    off = points - points[0]
    return float(np.linalg.norm(off - np.outer(off @ along, along), axis=1).max())


def test_on_a_track_the_tcp_keeps_its_line_in_the_world() -> None:
    data = target("a", 800, 0, 700, "0,9E9,9E9,9E9,9E9,9E9") + target(
        "b", 900, 1000, 600, "1000,9E9,9E9,9E9,9E9,9E9"
    )
    run = ran(
        program("MoveJ a,v500,fine,tool0;", "MoveL b,v500,fine,tool0;", data=data),
        external_axes=(TRACK,),
        model=MODELS["1"],
    )
    assert run.findings == []
    found = samples(run, 1)
    world_from_base = world_from_base_at((TRACK,), Transform.identity(), found.external)
    world = (world_from_base @ found.base_from_tcp).translation
    assert line_error(world) < 1e-9
    assert world[-1] == pytest.approx([0.9, 1.0, 0.6], abs=1e-9)
    assert found.external[-1, 0] == pytest.approx(1.0)
    # Speed is that of the TCP in the world: the track does half a metre a second with it.
    assert found.tcp_speed.max() == pytest.approx(0.5, abs=1e-3)
    # What is written down stands in the base of the robot, wherever that is.
    assert run.run.moves[1].base_from_tcp.translation == pytest.approx([0.9, 0.0, 0.6], abs=1e-9)


def test_a_positioner_takes_line_and_corner_along() -> None:
    data = target("a", 100, 0, 200, "9E9,0,9E9,9E9,9E9,9E9")
    data += target("b", 100, 100, 200, "9E9,45,9E9,9E9,9E9,9E9")
    data += target("c", 0, 100, 200, "9E9,90,9E9,9E9,9E9,9E9")
    on = r"tool0\WObj:=turntable;"
    run = ran(
        program(
            f"MoveJ a,v500,fine,{on}",
            f"MoveL b,v100,z10,{on}",
            f"MoveL c,v100,fine,{on}",
            data=data,
        ),
        external_axes=(TABLE,),
        model=MODELS["1"],
    )
    assert run.findings == []
    first, second = samples(run, 1), samples(run, 2)
    for found, where in ((first, slice(0, 40)), (second, slice(25, None))):
        back = rotation_from_vector(np.array([0.0, 0.0, -1.0]) * found.external)
        on_table = found.base_from_tcp.translation - TABLE.world_from_user.translation
        points = np.einsum("kij,kj->ki", back, on_table)[where]
        assert line_error(points) < 1e-9
        assert found.tcp_speed[where].max() == pytest.approx(0.1, abs=1e-3)
    assert second.external[-1, 0] == pytest.approx(np.pi / 2)
    assert run.run.moves[1].corner.value == "fly-by"
    # The user frame of the work object is where the positioner is, whatever `uframe` says.
    assert second.base_from_tcp.translation[-1] == pytest.approx([0.8, 0.1, 0.6], abs=1e-9)


def test_the_limit_of_a_move_names_unit_and_component_of_an_external_axis() -> None:
    data = "  CONST jointtarget far:=[[0,0,0,0,30,0],[%s,%s,9E9,9E9,9E9,9E9]];\n"
    for there, named in ((("2000", "0"), "eax_a of TRACK"), (("0", "170"), "eax_b of TABLE")):
        run = ran(
            program("MoveAbsJ far\\NoEOffs,vmax,fine,tool0;", data=data % there),
            external_axes=(TRACK, TABLE),
        ).run
        assert limits_of_moves(run) == {0: f"speed of axis {named}"}


def test_axes_keep_their_limits_and_programmed_speeds() -> None:
    data = "  CONST jointtarget far:=[[0,0,0,0,30,0],[2000,90,9E9,9E9,9E9,9E9]];\n"
    run = ran(
        program("MoveExtJ far,vlin200,fine;", "MoveAbsJ far\\NoEOffs,v1000,fine,tool0;", data=data),
        external_axes=(TRACK, TABLE),
    )
    external = run.run.only.trajectory.at(np.arange(0.0, run.run.time_s, 0.001)).external
    speed = np.abs(np.diff(external, axis=0)) / 0.001
    assert speed.max(axis=0)[0] == pytest.approx(0.2, rel=1e-3)
    assert np.diff(speed, axis=0).max() < 4.0 * 1.01
    # The turntable arrives with the track.
    assert external[-1] == pytest.approx([2.0, np.pi / 2])
    assert external[:, 1] == pytest.approx(external[:, 0] * np.pi / 4, abs=1e-9)
    assert run.run.moves[1].length_m == 0.0


def test_external_axes_move_alike_where_others_weld() -> None:
    data = "  CONST jointtarget far:=[[0,0,0,0,30,0],[2000,90,9E9,9E9,9E9,9E9]];\n"
    plain, welding = (
        ran(program(move, data=data), external_axes=(TRACK, TABLE))
        for move in ("MoveExtJ far,vlin200,fine;", "ArcMoveExtJ far,vlin200,fine\\Start;")
    )
    assert welding.findings == [("R104", welding.findings[0][1])]
    assert (welding.end, welding.run.time_s) == (plain.end, plain.run.time_s)
    (one,), (other,) = plain.run.moves, welding.run.moves
    assert (other.move.instruction, other.end_s) == ("ArcMoveExtJ", one.end_s)
    assert other.external == pytest.approx([2.0, np.pi / 2])


@pytest.mark.parametrize(
    ("axes", "code", "words"),
    [
        (NONE, "M520", "gives no value for eax_a of `TRACK`"),
        ("9999,9E9,9E9,9E9,9E9,9E9", "K602", "axis eax_a of TRACK at 9999.0 mm, 6999.0 mm past"),
    ],
)
def test_values_that_cannot_be_end_the_run(axes: str, code: str, words: str) -> None:
    data = target("p", 800, 0, 700, axes)
    run = ran(program("MoveJ p,v500,fine,tool0;", data=data), external_axes=(TRACK,))
    assert run.end == "error"
    assert words in run.only(code).violation.message


def test_no_error_clause_catches_a_missing_value() -> None:
    text = program("MoveJ p,v500,fine,tool0;", data=target("p", 800, 0, 700, NONE))
    caught = text.replace("  ENDPROC", "  ERROR\n    TRYNEXT;\n  ENDPROC")
    run = ran(caught, external_axes=(TRACK,))
    assert (run.end, run.findings) == ("error", [("M520", 8)])


def test_a_unit_that_is_off_needs_no_value_and_stays() -> None:
    data = target("p", 800, 0, 700, NONE)
    data += "  CONST jointtarget far:=[[0,0,0,0,30,0],[500,9E9,9E9,9E9,9E9,9E9]];\n"
    data += "  VAR jointtarget j;\n"
    run = ran(
        program(
            "MoveExtJ far,vlin1000,fine;",
            "DeactUnit TRACK;",
            'TPWrite "active: "\\Bool:=IsMechUnitActive(TRACK);',
            "MoveJ Offs(p,0,500,0),v500,fine,tool0;",
            "j:=CJointT();",
            'TPWrite "at "\\Num:=j.extax.eax_a;',
            data=data,
        ),
        external_axes=(TRACK,),
    )
    assert run.texts == ["active: FALSE", "at 500"]
    assert run.run.moves[-1].base_from_tcp.translation == pytest.approx([0.8, 0.0, 0.7], abs=1e-9)


def test_offsets_move_the_track_and_are_taken_off_again() -> None:
    data = target("p", 800, 0, 700, "0,9E9,9E9,9E9,9E9,9E9") + "  VAR jointtarget j;\n"
    run = ran(
        program(
            "EOffsSet [200,9E9,9E9,9E9,9E9,9E9];",
            "MoveJ p,v500,fine,tool0;",
            "j:=CJointT();",
            'TPWrite "as programmed "\\Num:=j.extax.eax_a;',
            "EOffsOff;",
            "j:=CJointT();",
            'TPWrite "stands at "\\Num:=j.extax.eax_a;',
            data=data,
        ),
        external_axes=(TRACK,),
    )
    assert run.texts == ["as programmed 0", "stands at 200"]
    assert run.run.moves[0].external == pytest.approx([0.2])


def test_a_base_off_the_world_is_taken_off_targets() -> None:
    data = target("p", 0, 800, 1200, NONE, "[0,0.70710678,0.70710678,0]") + "  VAR robtarget c;\n"
    lines = (
        "MoveJ p,v500,fine,tool0;",
        r"c:=CRobT(\Tool:=tool0\WObj:=wobj0);",
        'TPWrite ""\\Pos:=[Round(c.trans.x),Round(c.trans.y),Round(c.trans.z)];',
    )
    run = ran(program(*lines, data=data), world_from_base=QUARTER)
    assert run.texts == ["[0,800,1200]"]
    assert run.run.moves[0].base_from_tcp.translation == pytest.approx([0.8, 0.0, 0.7], abs=1e-7)
    assert run.run.moves[0].joints[0] == pytest.approx(0.0, abs=1e-6)


def test_a_unit_that_no_station_declares_is_told() -> None:
    data = target("p", 800, 0, 700, NONE)
    run = ran(program(r"MoveJ p,v500,fine,tool0\WObj:=turntable;", data=data))
    found = run.only("R104")
    assert "mechanical unit TABLE" in found.violation.message
    assert found.span is not None
    assert found.span.text == r"MoveJ p,v500,fine,tool0\WObj:=turntable"
    asked = ran(program(r"c:=CRobT(\Tool:=tool0\WObj:=turntable);", data="  VAR robtarget c;\n"))
    found = asked.only("R104")
    assert found.span is not None
    assert found.span.text.startswith("CRobT(")
    assert run.run.moves[0].base_from_tcp.translation == pytest.approx([0.807, 0.007, 0.707])


def test_json_and_samples_hold_the_external_axes() -> None:
    data = "  CONST jointtarget far:=[[0,0,0,0,30,0],[200,45,9E9,9E9,9E9,9E9]];\n"
    run = ran(program("MoveAbsJ far,v1000,fine,tool0;", data=data), external_axes=(TRACK, TABLE))
    written = json.loads(json.dumps(run_json(run.run, figures(run.run), [], RunFiles())))
    (move,) = written["moves"]
    assert move["external"] == {"eax_a": pytest.approx(200.0), "eax_b": pytest.approx(45.0)}
    assert run.run.only.sample(run.run.time_s).external[0] == pytest.approx([0.2, np.pi / 4])


STATION: Mapping[str, str] = {
    "name": '"TRACK"',
    "axis": '"a"',
    "kind": '"linear"',
    "limits": "[-500, 3000]",
    "speed": "1000",
    "carries": '"robot"',
    "direction": "[0, 2, 0]",
}


def station_file(folder: Path, **changes: str) -> Path:
    lines = [f"{key} = {value}" for key, value in {**STATION, **changes}.items() if value]
    file = folder / "rapidsim.toml"
    file.write_text("[[external_axis]]\n" + "\n".join(lines) + "\n")
    return file


def test_the_station_file_declares_axes_in_its_own_units(tmp_path: Path) -> None:
    (axis,) = read_station(station_file(tmp_path)).external_axes
    assert (axis.unit, axis.component, axis.linear, axis.carries) == (
        "TRACK",
        "eax_a",
        True,
        "robot",
    )
    assert (axis.lower, axis.upper, axis.max_speed) == (-0.5, 3.0, 1.0)
    assert axis.max_acceleration == pytest.approx(1.0 / 0.16)
    (turning,) = read_station(
        station_file(tmp_path, kind='"rotational"', speed="90", acceleration="180", carries="")
    ).external_axes
    assert (turning.max_speed, turning.max_acceleration) == (radians(90.0), radians(180.0))
    assert replace(turning, carries=None).measure == "deg"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"axis": '"g"'}, "axis: `g` is none of a, b, c, d, e, f"),
        ({"kind": '"screw"'}, "`screw` is neither `linear` nor `rotational`"),
        ({"limits": "[100, -100]"}, "limits: the first must be below the second"),
        ({"speed": ""}, "speed: is missing"),
        ({"carries": '"arm"'}, "`arm` is neither `robot` nor `wobj`"),
        ({"direction": "[0, 0, 0]"}, "a direction must not be all zeros"),
        ({"frame": "{ quaternion = [2, 0, 0, 0] }"}, "its length is 2, not 1"),
    ],
)
def test_a_wrong_axis_is_told_by_key(tmp_path: Path, changes: dict[str, str], words: str) -> None:
    with pytest.raises(InputError, match=words.replace("[", r"\[")):
        read_station(station_file(tmp_path, **changes))


def searched(search: str, data: str = "  VAR jointtarget j;\n") -> Ran:
    """Search along the track with an input that comes after 2 s and goes after 3 s."""
    data += "  CONST jointtarget far:=[[0,0,0,0,30,0],[1000,9E9,9E9,9E9,9E9,9E9]];\n"
    io = CellIo(
        stimuli=(
            Stimulus(values={"diHit": 1.0}, at_s=2.0),
            Stimulus(values={"diHit": 0.0}, at_s=3.0),
        ),
    )
    text = program(
        search,
        'TPWrite "hit "\\Num:=Round(j.extax.eax_a);',
        "TPWrite ValToStr(j.robax);",
        data=data,
    )
    return ran(
        text.replace(
            "  ENDPROC", "  ERROR\n    TPWrite ValToStr(ERRNO=ERR_WHLSEARCH);\n    EXIT;\n  ENDPROC"
        ),
        external_axes=(TRACK,),
        io=io,
    )


def test_a_search_of_external_axes_keeps_where_they_were() -> None:
    run = searched(r"SearchExtJ\SStop,diHit,j,far,vlin200;")
    at_hit = run.run.only.trajectory.at(np.array([2.0])).external[0, 0]
    assert run.texts == [f"hit {1000 * at_hit:.0f}", "[0,0,0,0,30,0]"]
    stands = run.run.only.trajectory.at(np.array([run.run.time_s])).external[0, 0]
    assert at_hit < stands < at_hit + 0.03
    assert run.run.unsimulated == ()


def test_a_search_of_external_axes_waits_for_its_flank_and_misses() -> None:
    falling = searched(r"SearchExtJ diHit\NegFlank,j,far,vlin200;")
    at_hit = falling.run.only.trajectory.at(np.array([3.0])).external[0, 0]
    assert falling.texts[0] == f"hit {1000 * at_hit:.0f}"
    end = falling.run.only.trajectory.at(np.array([falling.run.time_s])).external[0, 0]
    assert end == pytest.approx(1.0)  # Without a stop option it goes to the end.
    assert searched(r"SearchExtJ diOther,j,far,vlin200;").texts == ["TRUE"]
    twice = searched(r"SearchExtJ\Sup,diHit\Flanks,j,far,vlin200;")
    assert twice.texts == ["TRUE"]


def test_an_active_offset_is_taken_off_what_a_search_finds() -> None:
    data = "  VAR jointtarget j;\n  PROC offset()\n    EOffsSet [100,0,0,0,0,0];\n  ENDPROC\n"
    plain, moved = (
        searched(rf"offset; SearchExtJ\PStop,diHit,j,far{option},vlin200;", data)
        for option in ("", r"\UseEOffs")
    )
    assert (
        plain.texts[0]
        == "hit " + f"{1000 * plain.run.only.trajectory.at(np.array([2.0])).external[0, 0]:.0f}"
    )
    found = 1000 * moved.run.only.trajectory.at(np.array([2.0])).external[0, 0] - 100
    assert moved.texts[0] == f"hit {found:.0f}"
