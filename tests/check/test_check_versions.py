"""What a RobotWare has, also where its manuals do not say so, and what it does not have yet."""

from __future__ import annotations

from pathlib import Path

import pytest

from rapidsim.diagnostics import Severity
from rapidsim.jobs.checking.check_files import check

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


CONTINUES = """MODULE Old
  PROC main()
    WaitUntil Continue=1;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("station", "codes"),
    [
        ('[controller]\nrobotware = "7.0"\n', ["N211"]),
        ('[controller]\nrobotware = "6.12"\n', ["N201"]),
        ("", ["N201"]),
        ('[signals]\nContinue = { type = "di" }\n', []),
    ],
)
def test_a_signal_may_have_the_name_of_an_instruction_to_come(
    station: str, codes: list[str], tmp_path: Path
) -> None:
    (tmp_path / "rapidsim.toml").write_text(station)
    (tmp_path / "old.mod").write_text(CONTINUES)
    found = check([tmp_path / "old.mod"], robot="irb1600").diagnostics
    assert [one.code for one in found if one.severity is Severity.ERROR] == codes
