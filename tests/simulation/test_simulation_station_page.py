"""The gripper that the documentation shows works."""

import re
from pathlib import Path

import pytest
from simulation_program import ran

from rapidsim.station.read import read_io

ROOT = Path(__file__).parents[2]


def test_the_gripper_of_the_page_answers_and_is_five_lines(tmp_path: Path) -> None:
    page = (ROOT / "docs" / "station.md").read_text(encoding="utf-8")
    (gripper,) = (part for part in re.split(r"\n\n|```", page) if "a gripper that takes" in part)
    assert len(gripper.strip().splitlines()) <= 5
    file = tmp_path / "io.toml"
    file.write_text(gripper, encoding="utf-8")
    done = ran(
        """MODULE cell
  PROC main()
    FOR i FROM 1 TO 2 DO
      Set doGrip;
      WaitDI diGripped,1;
      Reset doGrip;
      WaitDI diGripped,0;
    ENDFOR
  ENDPROC
ENDMODULE
""",
        io=read_io(file),
    )
    closed = [event.time_s for event in done.run.events if event.message == "diGripped = 1"]
    opened = [event.time_s for event in done.run.events if event.message == "diGripped = 0"]
    assert done.end == "ended"
    assert closed == pytest.approx([0.4, 1.2], abs=1e-4)
    assert opened == pytest.approx([0.8, 1.6], abs=1e-4)
