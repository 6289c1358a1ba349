"""An error deep in a program: file, line, part of the line, and the calls that led there."""

import re
from pathlib import Path

from cli_helper import rapidsim

DEEP = """MODULE deep
  CONST num limits{3} := [1, 2, 3];
  PROC main()
    TPWrite "start";
    outer 4;
  ENDPROC

  PROC outer(num n)
    middle n + 1;
  ENDPROC

  PROC middle(num n)
    VAR num last;
    FOR i FROM 1 TO n DO
      last := last + third(i);
    ENDFOR
  ENDPROC

  FUNC num third(num k)
    RETURN 2 * limits{k} / k;
  ENDFUNC
ENDMODULE
"""
IN_CLAUSE = """MODULE again
  PROC main()
    VAR num part := 0;
    part := 6 / part;
  ERROR
    repair part;
    TRYNEXT;
  ENDPROC
  PROC repair(num part)
    part := 1 / part;
  ENDPROC
ENDMODULE
"""
TOOLS = Path(__file__).parents[2] / "docs" / "tools.md"


def test_the_page_about_tools_shows_what_is_printed(tmp_path: Path) -> None:
    (tmp_path / "deep.mod").write_text(DEEP)
    ended = rapidsim("run", "deep.mod", "--no-record", "-q", cwd=tmp_path)
    assert ended.code == 1
    assert f"```text\n{ended.out.rstrip()}\n```" in TOOLS.read_text("utf-8")


def test_a_call_out_of_a_clause_says_so(tmp_path: Path) -> None:
    (tmp_path / "again.mod").write_text(IN_CLAUSE)
    ended = rapidsim("run", "again.mod", "--no-record", "-q", cwd=tmp_path)
    assert "again.mod:10:13 in repair" in ended.out
    assert re.findall("called from (.*)", ended.out) == ["the ERROR clause of main", "main"]
