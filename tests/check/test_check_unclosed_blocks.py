"""A block without its end is one finding: where the repair puts the end proves nothing."""

from pathlib import Path

import pytest
from check_helper import found_in

UNCLOSED = (
    "IF n=1 THEN\n      RETURN;\n    n:=3;",
    "IF n=1 THEN\n      n:=2;\n    ELSE\n      RETURN;\n    n:=4;",
    "WHILE TRUE DO\n      IF n=1 THEN\n        EXIT;\n    ENDWHILE\n    n:=5;",
    "FOR i FROM 1 TO 3 DO\n      IF n=1 THEN\n        RETURN;\n      n:=3;\n    ENDFOR",
    "IF n=1 THEN\n      RAISE 3;\n    IF n=2 THEN\n      n:=5;\n    ENDIF\n    n:=8;",
)


@pytest.mark.parametrize("body", UNCLOSED)
def test_no_code_counts_as_unreachable_in_that_routine(body: str, tmp_path: Path) -> None:
    file = tmp_path / "job.mod"
    file.write_text(
        f"MODULE job\n  VAR num n;\n  PROC main()\n    {body}\n  ENDPROC\n"
        "  PROC other()\n    RETURN;\n    n:=3;\n  ENDPROC\nENDMODULE\n"
    )
    lines = file.read_text().splitlines()
    found = [(one.code, one.line) for one in found_in(file) if one.code in ("E102", "F401")]
    behind = next(number for number, line in enumerate(lines, 1) if "PROC other" in line) + 2
    assert [code for code, _ in found] == ["E102", "F401"]
    assert found[-1] == ("F401", behind)
