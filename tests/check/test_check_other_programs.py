"""What only another program knows, a sensor or a value of a persistent, is no error of a check."""

from __future__ import annotations

from pathlib import Path

import rapidsim

SENSOR = """MODULE guided
  VAR egmident guide;
  CONST egm_minmax near:=[-0.1,0.1];
  PROC main()
    EGMGetId guide;
    EGMSetupUC ROB_1,guide,"default","UCdevice"\\Joint\\CommTimeout:=1;
    EGMActJoint guide\\J1:=near;
    EGMRunJoint guide,EGM_STOP_HOLD\\J1;
  ENDPROC
ENDMODULE
"""
TARGETS = """MODULE moved
  PERS robtarget there;
  PERS robtarget here;
  PROC main()
    MoveJ there,v100,fine,tool0;
    MoveL Offs(here,0,0,100),v100,fine,tool0;
  ENDPROC
ENDMODULE
"""


def _found(folder: Path, text: str) -> list[tuple[str, str]]:
    path = folder / "a.mod"
    path.write_text(text, encoding="utf-8")
    return [(one.code, str(one.severity)) for one in rapidsim.load(path).check().diagnostics]


def test_a_silent_sensor_is_a_warning(tmp_path: Path) -> None:
    assert _found(tmp_path, SENSOR) == [("R101", "warning")]


def test_a_persistent_target_without_a_value_is_zero_unless_another_task_gives_it(
    tmp_path: Path,
) -> None:
    """The controller stops at zeros, and so do check and run, which say the same."""
    assert _found(tmp_path, TARGETS) == [("M501", "warning")]
    run = rapidsim.load(tmp_path / "a.mod").run()
    assert run.end == "error"
    checked = rapidsim.load(tmp_path / "a.mod").check().diagnostics
    told = [
        [(one.code, one.line, str(one.severity)) for one in of] for of in (checked, run.diagnostics)
    ]
    assert told == [[("M501", 5, "warning")]] * 2
    assert "another task" in str(checked[0].help)


def test_a_cell_whose_other_task_gives_the_value_moves_there(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text(
        '[[task]]\nname="T_ROB1"\nmodules=["a.mod"]\n[[task]]\nname="T_SET"\n'
        'modules=["b.mod"]\nmotion=false\n'
    )
    pose = "[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    (tmp_path / "a.mod").write_text(TARGETS)
    (tmp_path / "b.mod").write_text(
        f"MODULE b\n  PERS robtarget there:={pose};\n  PERS robtarget here:={pose};\n"
        "  PROC main()\n  ENDPROC\nENDMODULE\n"
    )
    assert not [one for one in rapidsim.load(tmp_path).check().diagnostics if one.code == "M501"]
    run = rapidsim.load(tmp_path).run()
    assert (run.end, len(run.moves)) == ("ended", 2)


def test_a_variable_target_without_a_value_is_zero(tmp_path: Path) -> None:
    found = [code for code, _ in _found(tmp_path, TARGETS.replace("PERS", "VAR"))]
    assert found == ["F412", "M501", "M501", "F412"]
