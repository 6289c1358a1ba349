"""What a check runs main for, where there is no move: whatever can end in an error."""

import pytest

from rapidsim.analysis.can_fail import can_fail
from rapidsim.analysis.passes.checker import check
from rapidsim.diagnostics import Source
from rapidsim.syntax.parser import parse

TEXT = """MODULE Any
  VAR num x:=1;
  VAR num list{2};
  VAR string word;
  PROC main()
    {}
  ENDPROC
  PROC other()
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("statement", "fails"),
    [
        ('TPWrite "x is "\\Num:=x;', False),
        ("x:=-(x+2)*3;", False),
        ("IF x>2 AND NOT (x=3) x:=0;", False),
        ("FOR i FROM 1 TO 3 DO x:=x+i; ENDFOR", False),
        ("x:=1/x;", True),
        ("x:=4 MOD x;", True),
        ("x:=list{x};", True),
        ('word:=word+"a";', True),
        ("x:=Sqrt(x);", True),
        ("other;", True),
        ("RAISE ERR_DIVZERO;", True),
        ("<SMT>", True),
    ],
)
def test_what_only_computes_and_tells_cannot_fail(statement: str, fails: bool) -> None:
    parsed = parse(Source("any.mod", TEXT.replace("{}", statement, 1)))
    program = check([parsed.file]).program
    assert program is not None
    assert can_fail(program) is fails
