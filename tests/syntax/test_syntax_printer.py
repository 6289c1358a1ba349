"""What is printed parses to the tree that was printed, and printed again it is the same text."""

from __future__ import annotations

from pathlib import Path

import pytest
from syntax_trees import shape

from rapidsim.diagnostics import Source
from rapidsim.syntax.parser import parse
from rapidsim.syntax.printer import print_module

ROOT = Path(__file__).parents[2]


FOLDERS = ("programs", "tests/syntax/programs", "tests/rapid")
PROGRAMS = [
    path
    for folder in FOLDERS
    for path in sorted((ROOT / folder).rglob("*"))
    if path.suffix in (".mod", ".sys")
]


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_printing_keeps_the_tree_and_printing_again_the_text(program: Path) -> None:
    parsed = parse(Source(program.name, program.read_text(encoding="utf-8")))
    if parsed.diagnostics:
        return  # Programs with planted syntax errors have no whole tree to print.
    modules = parsed.file.modules
    printed = "".join(print_module(module) for module in modules)
    again = parse(Source("printed", printed))
    assert not again.diagnostics, printed
    assert shape(again.file.modules) == shape(modules)
    assert "".join(print_module(module) for module in again.file.modules) == printed


@pytest.mark.parametrize(
    "statement",
    [
        "x=1;",
        "P(a,b);",
        "P();",
        "x:=a*-2;",
        "x:=a AND NOT b;",
        "WHILE a x:=1; ENDWHILE",
        "IF a THEN ELSEIF b x:=1; ELSE ENDIF",
        "TEST a CASE 1 TO 5: CASE 7: ENDTEST",
        "IF a <SMT>",
        "IF a THEN <EIT> ENDIF",
        "TEST a <CSE> DEFAULT: ENDTEST",
        'x:=%"f"%(1);',
        r'TPWrite "a""b\\c\0D";',
        'x:=[1e30,1E-9,-0.0,123456789,[TRUE,"s"]];',
        "<VAR>:=1;",
        "MoveL *,v100;",
        "VAR num x=1;",
        ";",
    ],
)
def test_printing_keeps_odd_statements(statement: str) -> None:
    text = f"MODULE m\nPROC p\n{statement}\nENDPROC\nENDMODULE\n"
    first = parse(Source("odd", text))
    assert not first.diagnostics
    printed = print_module(first.file.modules[0])
    assert shape(parse(Source("printed", printed)).file.modules) == shape(first.file.modules)
