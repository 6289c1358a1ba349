"""The arm that nobody names: the catalogue is ranked by the targets of the program."""

import json
import random
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from command_line import call
from whole_findings import assert_section

from rapidsim.analysis.program import Program
from rapidsim.jobs.checking import best_arm
from rapidsim.jobs.checking.best_arm import with_best_arm
from rapidsim.jobs.inputs.job import Job
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.robot.robot import load_robot
from rapidsim.reach.arm_ranking import Hint, hints_of

ARMS = (
    "irb120-3-0.58",
    "irb140-6-0.81",
    "irb1200-5-0.9",
    "irb1600-8-1.45",
    "irb2600-20-1.65",
    "irb4600-40-2.55",
    "irb6640-180-2.55",
    "irb6700-200-2.6",
    "irb1660id-6-1.55",
    "irb2400-16-1.55",
)
NOT_USED = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def program(arm: str, comment: str = "", count: int = 25) -> str:
    """Moves to random targets of an arm, in the configurations that it has there."""
    robot, random_ = load_robot(arm), random.Random(arm)
    lines = []
    for _ in range(count):
        joints = np.array([random_.uniform(0.9 * j.lower, 0.9 * j.upper) for j in robot.joints])
        joints[[3, 5]] = [random_.uniform(-1.5, 1.5), random_.uniform(-1.5, 1.5)]
        flange = robot.forward(joints)
        place = ",".join(f"{1000.0 * x:.3f}" for x in flange.translation)
        turned = ",".join(f"{q:.7f}" for q in flange.quaternion)
        stored = ",".join(str(one) for one in confdata_of(robot.kinematics, joints))
        target = f"[[{place}],[{turned}],[{stored}],{NOT_USED}]"
        lines.append(f"    MoveJ {target},v100,fine,tool0;")
    text = "\n".join(lines)
    return f"MODULE Job\n  ! {comment}\n  PROC main()\n{text}\n  ENDPROC\nENDMODULE\n"


def ranking(folder: Path) -> dict[str, int]:
    ended = call("robots", "--for", "Job.mod", "--format", "json", cwd=folder)
    assert ended.code == 0, ended.err
    return {one["name"]: one["rank"] for one in json.loads(ended.out)["robots"]}


@pytest.mark.parametrize("arm", ARMS)
def test_the_arm_of_a_program_is_first_or_tied(arm: str, tmp_path: Path) -> None:
    (tmp_path / "Job.mod").write_text(program(arm))
    ranked = ranking(tmp_path)
    assert ranked[arm] == 1
    assert list(ranked.values()) == sorted(ranked.values())
    checked = call("check", "Job.mod", cwd=tmp_path).out
    assert "best of the catalogue: 25 of 25 targets reached, 25 as stored; next " in checked or (
        arm == "irb1600-6-1.2"
    )


@pytest.mark.parametrize(
    "comment", ["IRB 140", "for the IRB140-6/0.81", "irb140", "made by hand on an Irb_140 6kg"]
)
def test_a_tie_goes_to_the_arm_that_a_comment_names(comment: str, tmp_path: Path) -> None:
    near = program("irb120-3-0.58", comment)
    (tmp_path / "Job.mod").write_text(near)
    ranked = ranking(tmp_path)
    tied = [name for name, rank in ranked.items() if rank == 1]
    assert "irb120-3-0.58" in tied
    if "irb140-6-0.81" in tied:
        assert tied[0] == "irb140-6-0.81"


def test_the_default_arm_stays_where_it_makes_all(tmp_path: Path) -> None:
    (tmp_path / "Job.mod").write_text(program("irb1600-6-1.2"))
    assert "irb1600-6-1.2 (by default; --robot names another)" in call(
        "check", "Job.mod", cwd=tmp_path
    ).out.replace("\n", " ")
    (tmp_path / "Job.mod").write_text(program("irb1600-6-1.2", "of an IRB 1600-8/1.45"))
    ranked = ranking(tmp_path)
    if ranked["irb1600-8-1.45"] == 1:
        assert "on irb1600-8-1.45 (best of the catalogue" in call(
            "check", "Job.mod", cwd=tmp_path
        ).out.replace("\n", " ")


def test_both_doors_take_the_same_arm(tmp_path: Path) -> None:
    (tmp_path / "Job.mod").write_text(program("irb6640-180-2.55", count=8))
    checked = call("check", "Job.mod", "--no-cache", cwd=tmp_path).out
    ran = call("run", "Job.mod", "--no-record", "--format", "json", cwd=tmp_path)
    named = json.loads(ran.out)["robot"]
    assert f"on {named} (best of the catalogue" in checked.replace("\n", " ")
    again = call("check", "Job.mod", cwd=tmp_path).out
    assert f"on {named} (best of the catalogue" in again.replace("\n", " ")
    said = call("run", "Job.mod", "--no-record", cwd=tmp_path).out.replace("\n", " ")
    assert "best of the catalogue" in " ".join(said.split())


def test_several_tasks_are_looked_at_once_for_their_arm(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.mod").write_text(near().replace("Job", "a"))
    (tmp_path / "b.mod").write_text("MODULE b\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    (tmp_path / "rapidsim.toml").write_text(
        '[[task]]\nname = "T_ROB1"\nmodules = ["a.mod"]\n'
        '[[task]]\nname = "T_OTHER"\nmodules = ["b.mod"]\n'
    )
    chosen: list[str] = []

    def noted(job: Job, programs: Sequence[Program]) -> Job:
        found = with_best_arm(job, programs)
        chosen.append(found.robot.name)
        return found

    monkeypatch.setattr(best_arm, "with_best_arm", noted)
    checked = " ".join(call("check", ".", "--no-run", cwd=tmp_path).out.split())
    assert len(chosen) == 1
    assert f"on {chosen[0]} (best of the catalogue" in checked


def test_what_a_guess_does_not_reach_is_a_warning(tmp_path: Path) -> None:
    far = program("irb6640-180-2.55", count=3).replace(
        "  ENDPROC",
        f"    MoveJ [[90000,0,500],[1,0,0,0],[0,0,0,0],{NOT_USED}],v100,fine,tool0;\n  ENDPROC",
    )
    (tmp_path / "Job.mod").write_text(far)
    checked = json.loads(call("check", "Job.mod", "--output-format", "json", cwd=tmp_path).out)
    ran = call("run", "Job.mod", "--no-record", "--format", "json", cwd=tmp_path)
    run = json.loads(ran.out)
    for report in (checked, run):
        found = [one for one in report["diagnostics"] if one["code"] == "K601"]
        assert [one["severity"] for one in found] == ["warning"]
    assert (ran.code, run["end"]) == (1, "error")


def test_arms_are_ranked_for_programs_only(tmp_path: Path) -> None:
    (tmp_path / "Job.mod").write_text("MODULE Job\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    ended = call("robots", "--for", "Job.mod", cwd=tmp_path)
    assert (ended.code, "no target of Job.mod is known" in ended.err.replace("\n", " ")) == (
        2,
        True,
    )
    for more in (("irb120",), ("--table",), ("--workspace",)):
        assert call("robots", "--for", "Job.mod", *more, cwd=tmp_path).code == 2
    assert call("robots", "--for", "absent.mod", cwd=tmp_path).code == 2


def test_the_table_names_the_best(tmp_path: Path) -> None:
    (tmp_path / "Job.mod").write_text(program("irb120-3-0.58", "IRB 120"))
    out = call("robots", "--for", "Job.mod", cwd=tmp_path).out
    first = out.splitlines()[1].split()
    assert first[:2] == ["1", "irb120-3-0.58"]
    assert "named" in first
    assert "25 targets, heaviest tool 0.001 kg" in " ".join(out.split())


def near(out: float = 0.0, eax_a: str = "9E9") -> str:
    """Targets in the middle of the space of small arms [mm], which many others reach, too."""
    poses = [(250, -150, 400), (300, 0, 350), (250, 150, 400), (200, 100, 450)]
    moves = "\n".join(
        f"    MoveJ [[{x + out:g},{y},{z}],[0,0,1,0],[0,0,0,0],[{eax_a},9E9,9E9,9E9,9E9,9E9]],"
        "v100,fine,tool0;"
        for x, y, z in poses
    )
    return f"MODULE Job\n  PROC main()\n{moves}\n  ENDPROC\nENDMODULE\n"


def best(folder: Path, path: str = "Job.mod") -> str:
    ended = call("robots", "--for", path, "--format", "json", cwd=folder)
    assert ended.code == 0, ended.err
    return str(json.loads(ended.out)["robots"][0]["name"])


@pytest.mark.parametrize(
    ("folders", "beside", "arm"),
    [
        ("Solution_IRB_1200/Rapid/T_ROB1", "", "irb1200-"),
        ("cell/irb140", "", "irb140-6-0.81"),
        ("cell/Rapid", "IRB1200_5_90.rsstn", "irb1200-5-0.9"),
        ("IRB1300_11_90", "", "irb1300-11-0.9"),
        ("CRB1300_11_90", "", "crb1300-11-0.9"),
    ],
)
def test_names_of_folders_and_stations_name_the_arm(
    tmp_path: Path, folders: str, beside: str, arm: str
) -> None:
    """Many arms reach these targets as they are stored."""
    folder = tmp_path / folders
    folder.mkdir(parents=True)
    (folder / "Job.mod").write_text(near(out=300.0 if "1300" in arm else 0.0))
    if beside:
        (folder.parent / beside).write_bytes(b"")
    assert best(folder).startswith(arm)
    assert best(tmp_path, folders).startswith(arm)
    checked = " ".join(call("check", folders, cwd=tmp_path).out.split())
    assert f"on {arm}" in checked


def test_a_name_counts_where_no_arm_reaches_the_targets(tmp_path: Path) -> None:
    """The robot stands elsewhere: only one of five targets is near it."""
    far = near().replace("[[250,", "[[9250,").replace("[[200,", "[[9200,")
    (tmp_path / "Job.mod").write_text(far)
    assert not best(tmp_path).startswith("irb140-")
    named = far.replace("MODULE Job", "MODULE Job\n  ! for an IRB 140")
    (tmp_path / "Job.mod").write_text(named)
    assert best(tmp_path).startswith("irb140-")


SEVEN = "irb14000-0.5-0.5"


def of_yumi(side: str, count: int = 2) -> str:
    """Moves to targets of an arm of a YuMi, with `eax_a` as its programs have it."""
    robot, random_ = load_robot(f"{SEVEN}-{side}"), random.Random(3)
    lines = []
    for _ in range(count):
        joints = np.radians([0, -130, 135 if side == "left" else -135, 30, 0, 40, 0])
        flange = robot.forward(joints + np.array([random_.uniform(-0.2, 0.2) for _ in range(7)]))
        place = ",".join(f"{1000.0 * x:.3f}" for x in flange.translation)
        turned = ",".join(f"{q:.7f}" for q in flange.quaternion)
        target = f"[[{place}],[{turned}],[0,0,0,4],[101.96,9E9,9E9,9E9,9E9,9E9]]"
        lines.append(f"    MoveJ {target},v100,fine,tool0;")
    text = "\n".join(lines)
    return f"MODULE Job\n  PROC main()\n{text}\n  ENDPROC\nENDMODULE\n"


@pytest.mark.parametrize("side", ["left", "right"])
def test_targets_with_seven_axes_are_offered_arms_with_seven_axes(
    tmp_path: Path, side: str
) -> None:
    (tmp_path / "Job.mod").write_text(of_yumi(side))
    ranked = ranking(tmp_path)
    assert set(ranked) == {SEVEN, f"{SEVEN}-left", f"{SEVEN}-right", "irb14050-0.5-0.5"}
    assert ranked[f"{SEVEN}-{side}"] == 1
    folder = tmp_path / f"T_ROB_{side[0].upper()}"
    folder.mkdir()
    (folder / "Job.mod").write_text(of_yumi(side))
    assert best(folder) == f"{SEVEN}-{side}"


def test_a_track_is_no_seventh_axis(tmp_path: Path) -> None:
    """Positions of a track [mm], or an axis that the station declares."""
    for eax_a in ("1500", "0"):
        (tmp_path / "Job.mod").write_text(near(eax_a=eax_a))
        assert len(load_robot(best(tmp_path)).joints) == 6
    (tmp_path / "Job.mod").write_text(near(eax_a="100"))
    (tmp_path / "rapidsim.toml").write_text(
        '[[external_axis]]\nname = "TRACK"\naxis = "a"\nkind = "linear"\ncarries = "robot"\n'
        "limits = [0, 3000]\nspeed = 1000\n"
    )
    assert len(load_robot(best(tmp_path)).joints) == 6


def test_the_unit_of_a_two_armed_robot_names_its_type(tmp_path: Path) -> None:
    (tmp_path / "Job.mod").write_text(
        "MODULE Job\n  VAR egmident id;\n  PROC main()\n"
        "    MoveAbsJ [[0,-130,30,0,40,0],[135,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n"
        '    EGMSetupUC ROB_L,id,"default","sensor"\\Joint;\n  ENDPROC\nENDMODULE\n'
    )
    ran = call("run", "Job.mod", "--no-record", "--format", "json", cwd=tmp_path)
    assert json.loads(ran.out)["robot"] == "irb14000-0.5-0.5"


def test_a_run_that_ends_where_the_arm_is_a_guess_says_so(tmp_path: Path) -> None:
    # Joint 1 is past the limit of every arm, so no arm of the catalogue is the right one.
    (tmp_path / "Job.mod").write_text(
        "MODULE Job\n  PROC main()\n"
        "    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n"
        "    MoveAbsJ [[9000,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n"
        "  ENDPROC\nENDMODULE\n"
    )
    guessed = call("run", "Job.mod", "--no-record", cwd=tmp_path, columns=200)
    assert guessed.code == 1
    assert "stopped at Job.mod:4, which the arm or frame assumed here does not allow" in guessed.out
    named = call("run", "Job.mod", "--no-record", "--robot", "irb120", cwd=tmp_path, columns=200)
    assert named.code == 1
    assert "stopped with an error after" in named.out


TEXTS: tuple[tuple[str, tuple[str, ...], tuple[Hint, ...]], ...] = (
    ("IRB 1600-6/1.2", (), (Hint("1600", (6.0, 1.2), "irb"),)),
    ("IRB1600 irb_1600", (), (Hint("1600", (), "irb"),)),
    (
        "a CRB 15000-5/0.95 and IRB_120",
        (),
        (Hint("15000", (5.0, 0.95), "crb"), Hint("120", (), "irb")),
    ),
    ("ROB1_6700_235kg", (), (Hint("6700", (235.0,), "irb"),)),
    ("IRB 1600 0/1.45", (), (Hint("1600", (1.45,), "irb"),)),
    ("IRB 4600-20kg/2.5m", (), (Hint("4600", (20.0, 2.5), "irb"),)),
    ("yumi or GoFa", (), (Hint("14000"), Hint("15000"))),
    ("ayumi, yumis, xirb1600, IRB 16", (), ()),
    ("T_ROB_L", (), ()),
    ("", ("T_ROB_L",), (Hint("14000", side="l"),)),
    ("", ("YUMI-right",), (Hint("14000", side="r"),)),
    ("", ("T_ROB_L", "T_ROB_R"), ()),
    (
        "YuMi, IRB 2600 20/1.65",
        ("T_ROB_R",),
        (Hint("14000", side="r"), Hint("2600", (20.0, 1.65), "irb")),
    ),
)


@pytest.mark.parametrize(("text", "names", "hints"), TEXTS, ids=range(len(TEXTS)))
def test_the_arms_that_texts_name(
    text: str, names: tuple[str, ...], hints: tuple[Hint, ...]
) -> None:
    assert hints_of([text], names) == hints


@pytest.mark.parametrize(
    ("hint", "name", "deviation"),
    [
        (Hint("1600"), "irb1600-6-1.2", 0.0),
        (Hint("1600", (6.0, 1.2)), "irb1600-6-1.2", 0.0),
        (Hint("1600", (1.45,)), "irb1600-6-1.2", 0.25 / 1.45),
        (Hint("1600", (7.0,)), "irb1600-10-1.45", 0.3),
        (Hint("1600", (6.0, 1.2)), "irb1600-10-1.45", 0.4 + 0.25 / 1.45),
        (Hint("1600", (), "crb"), "irb1600-6-1.2", 1.0),
        (Hint("14000", side="l"), "irb14000-0.5-0.5-left", 0.0),
        (Hint("14000", side="l"), "irb14000-0.5-0.5-right", 1.0),
        (Hint("14000", side="l"), "irb14000-0.5-0.5", 1.0),
        (Hint("2600", (6.0,)), "irb1600-6-1.2", 10.0),
        (Hint("2600"), "kr10", 20.0),
    ],
)
def test_how_far_an_arm_is_from_what_texts_name(hint: Hint, name: str, deviation: float) -> None:
    assert hint.deviation(name) == pytest.approx(deviation)


@pytest.mark.parametrize(
    ("title", "text"),
    [
        ("near", near()),
        ("far", near(out=600.0)),
        ("too far", near(out=9000.0)),
        ("a name", near().replace("MODULE Job", "MODULE Job\n  ! IRB 1200-7/0.7")),
        ("a name too far", near(out=9000.0).replace("MODULE Job", "MODULE Job\n  ! IRB 140")),
        ("axes", near().replace("ENDPROC", f"MoveAbsJ [[170,0,0,0,30,0],{NOT_USED}],v10,z1,t;")),
        ("an angle", near(eax_a="45")),
    ],
)
def test_all_arms_in_order(title: str, text: str, tmp_path: Path) -> None:
    tool = "PERS tooldata t:=[TRUE,[[0,0,50],[1,0,0,0]],[12,[0,0,1],[1,0,0,0],0,0,0]];"
    if "ENDPROC" not in text:
        text = text.replace("\nENDMODULE", f"\n  ENDPROC\n  {tool}\nENDMODULE")
    (tmp_path / "Job.mod").write_text(text)
    ended = call("robots", "--for", "Job.mod", "--format", "json", cwd=tmp_path)
    found = json.loads(ended.out)["robots"]
    lines = (" ".join(f"{key}={value}" for key, value in one.items()) for one in found[:12])
    told = "".join(f"{line}\n" for line in lines)
    assert_section(Path(__file__).parent / "golden" / "arms.txt", title, told)
