"""Paths that the turns of a loop repeat are built once, and found wrong each time."""

import json
from pathlib import Path

import pytest
from command_line import call

from rapidsim.motion.path.building import build_path
from rapidsim.reach import path_findings

PROGRAM = """MODULE turns
  CONST extjoint none:=[9E9,9E9,9E9,9E9,9E9,9E9];
  CONST robtarget a:=[[556,267,476],[1,0,0,0],[0,0,0,0],none];
  CONST robtarget b:=[[590,-67,594],[0,0,1,0],[0,0,0,0],none];
  CONST robtarget c:=[[744,-237,567],[0,0.7071068,0.7071068,0],[-1,0,-1,0],none];
  CONST robtarget d:=[[700,-184,473],[0,0,1,0],[-1,0,-1,0],none];
  PROC main()
    FOR i FROM 1 TO {turns} DO
      MoveC a,Offs(a,20,20,0),v500,fine,tool0;
      MoveJ b,v1000,z200,tool0;
      MoveC c,Offs(c,20,20,0),v500,z0,tool0;
      MoveC d,Offs(d,20,20,0),v500,z50,tool0;
    ENDFOR
  ENDPROC
ENDMODULE
"""


def test_a_path_that_fails_in_each_turn_is_built_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    built = []

    def counted(*arguments: object) -> object:
        built.append(1)
        return build_path(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(path_findings, "build_path", counted)
    found = []
    for turns in (3, 60):
        built.clear()
        file = tmp_path / "turns.mod"
        file.write_text(PROGRAM.format(turns=turns))
        options = ("--robot", "irb1300-10-1.15", "--output-format", "json")
        ended = call("check", str(file), *options, cwd=tmp_path)
        found.append((len(built), json.loads(ended.out)["diagnostics"]))
    (once, texts), (often, others) = found
    assert 0 < once <= often <= once + 1
    assert texts == others
    assert {one["code"] for one in texts} >= {"K604"}
