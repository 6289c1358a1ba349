"""What a RobotWare has that its manuals lack."""

from __future__ import annotations

from pathlib import Path

import pytest

from rapidsim.jobs.check_files import check

PROGRAM = r"""MODULE Late
  VAR egmident guide;
  PROC main()
    TPWrite StrFormat("{1}"\Arg1:="a");
    EGMGetId guide;
    EGMRunJoint guide,EGM_STOP_HOLD\NoWaitCond\J1;
    EGMWaitCond guide;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("robotware", "lines"), [("6.12", [4, 6, 7]), ("6.14", []), ("6.16", []), ("7.0", [])]
)
def test_what_programs_for_late_versions_of_robotware_6_use_is_known_there(
    robotware: str, lines: list[int], tmp_path: Path
) -> None:
    (tmp_path / "rapidsim.toml").write_text(f'[controller]\nrobotware = "{robotware}"\n')
    (tmp_path / "late.mod").write_text(PROGRAM)
    found = check([tmp_path / "late.mod"], robot="irb1600").diagnostics
    newer = [one for one in found if one.violation.code == "N219"]
    assert [one.line for one in newer] == lines
