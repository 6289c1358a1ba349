"""Literals of declarations: each value as a run has it, and None for what is no literal."""

import pytest

from rapidsim.analysis.literals import literal
from rapidsim.analysis.program import DataSymbol
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.data import Pos


@pytest.mark.parametrize(
    ("declared", "value"),
    [
        ("num x:=3", 3.0),
        ("num x:=-3", -3.0),
        ("num x:=+(-3)", -3.0),
        ("num x:=(0.1)", 0.10000000149011612),
        ("dnum x:=(0.1)", 0.1),
        ("num x:=1+2", None),
        ("num x:=n", None),
        ("num x:=-n", None),
        ("bool x:=(TRUE)", True),
        ('string x:="a"', "a"),
        ("pos x:=[1,-2,3]", Pos(1.0, -2.0, 3.0)),
        ("pos x:=[1,-(2),(3)]", Pos(1.0, -2.0, 3.0)),
        ("pos x:=[1,n,3]", None),
        ("num x{2}:=[1,-(2)]", [1.0, -2.0]),
        ("num x{2}:=[1,n]", None),
        ("pos x{2}:=[[1,2,3],[(4),5,6]]", [Pos(1.0, 2.0, 3.0), Pos(4.0, 5.0, 6.0)]),
    ],
)
def test_the_value_of_a_declaration(declared: str, value: object) -> None:
    text = f"MODULE m\nCONST num n:=1;\nCONST {declared};\nENDMODULE\n"
    program = load([SourceFile("m.mod", text, "utf-8")]).program
    assert program is not None
    (symbol,) = (
        one for one in program.symbol_of.values() if isinstance(one, DataSymbol) and one.name == "x"
    )
    assert symbol.node is not None
    found = literal(symbol.node.value, symbol.type)
    assert found == value
    assert type(found) is type(value)
