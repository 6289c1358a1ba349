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


def test_a_persistent_target_without_a_value_is_unknown(tmp_path: Path) -> None:
    assert _found(tmp_path, TARGETS) == []


def test_a_variable_target_without_a_value_is_zero(tmp_path: Path) -> None:
    found = [code for code, _ in _found(tmp_path, TARGETS.replace("PERS", "VAR"))]
    assert found == ["F412", "M501", "M501", "F412"]
