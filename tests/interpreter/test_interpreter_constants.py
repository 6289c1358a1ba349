"""Constants: what a check knows without a run is what the run computes, bit for bit."""

from collections.abc import Mapping

import pytest
from hypothesis import given
from hypothesis import strategies as st
from interpreter_cell import checked, main, run, texts
from laws import examples

from rapidsim.analysis.evaluation import NOT_STATIC, Evaluator, Known, NotStatic
from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.language.single_precision import single
from rapidsim.language.types import NUM
from rapidsim.syntax import tree

NUMBERS = ["0", "1", "2", "3", "7", "0.1", "0.5", "3.75", "16777215", "16777217", "1E10", "1E-10"]
EXPRESSIONS = st.recursive(
    st.sampled_from(NUMBERS),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["+", "-", "*", "/", "DIV", "MOD"]), inner).map(
            lambda parts: f"({' '.join(parts)})"
        ),
        inner.map(lambda part: f"(-{part})"),
        inner.map(lambda part: f"(+{part})"),
    ),
    max_leaves=6,
)


@examples(60)
@given(st.lists(EXPRESSIONS, min_size=8, max_size=8))
def test_a_constant_expression_is_what_a_run_computes(expressions: list[str]) -> None:
    program = checked(
        main("", " ".join(f"VAR num r{n} := {e};" for n, e in enumerate(expressions)))
    )
    declared = [item for item in program.modules[0].items if isinstance(item, tree.Data)]
    evaluator = Evaluator(program, lambda _: NOT_STATIC)
    known = [evaluator.value(item.value, NUM) for item in declared if item.value is not None]
    static = [
        (text, value)
        for text, value in zip(expressions, known, strict=True)
        if not isinstance(value, NotStatic)
    ]
    # With a variable in it, the run computes the expression when it gets there.
    statements = "\n".join(
        f"r := zero + {text};\nTPWrite ValToStr(NumToDnum(r));" for text, _ in static
    )
    shown = texts(main(statements, "VAR num r; VAR num zero;"))
    assert [single(float(text)) for text in shown] == [single(value) for _, value in static]


def test_the_size_of_an_array_is_that_of_a_run() -> None:
    """In single precision 16777216 - 16777215 is 1, though 16777217 was written."""
    data = "CONST num big := 16777217; VAR num list{big - 16777215};"
    assert texts(main("TPWrite ValToStr(Dim(list, 1));", data)) == ["1"]
    assert texts(main("TPWrite ValToStr(big - 16777215);", data)) == ["1"]


DATA = """
RECORD pair
  num first;
  pos place;
ENDRECORD
CONST num n := 3;
CONST num row{3} := [1, 2, 4];
CONST num table{2,2} := [[1, 2], [3, -4]];
CONST pos p := [1, 2, 3];
CONST pos q := [4, 5, 6];
CONST orient o := [0, 1, 0, 0];
CONST bool yes := TRUE;
CONST bool no := FALSE;
CONST string ab := "ab";
CONST dnum wide := 16777217;
CONST pair both := [7, [1, 2, 3]];
VAR num asked;
VAR bool hidden;
"""
VALUES: Mapping[str, Mapping[str, object]] = {
    "num": {
        "n + n * 2": 9.0,
        "-n DIV 2": -1.0,
        "-n MOD 2": -1.0,
        "row{1}": 1.0,
        "row{n}": 4.0,
        "table{2, n - 1}": -4.0,
        "p.x - q.z": -5.0,
        "both.place.y": 2.0,
        "+row{2} - -n": 5.0,
        "0.1": single(0.1),
    },
    "dnum": {"wide + 1": 16777218.0, "-wide": -16777217.0, "0.1": 0.1},
    "bool": {
        "n < 3": False,
        "n <= 3": True,
        "n > 3": False,
        "n >= 3": True,
        "n = 3": True,
        "n <> 3": False,
        "p = q": False,
        "p <> q": True,
        'ab = "ab"': True,
        'ab <> "AB"': True,
        "yes = no": False,
        "NOT no": True,
        "yes AND no": False,
        "yes AND yes": True,
        "no OR yes": True,
        "no OR no": False,
        "yes XOR yes": False,
        "yes XOR no": True,
        "no AND hidden": False,
        "yes OR hidden": True,
        "(0.1 + 0.2) = 0.3": True,
    },
    "string": {'ab + "c" + ab': "abcab"},
    "pos": {
        "p + q": (5.0, 7.0, 9.0),
        "p - q": (-3.0, -3.0, -3.0),
        "p * 2": (2.0, 4.0, 6.0),
        "2 * p": (2.0, 4.0, 6.0),
        "p / 2": (0.5, 1.0, 1.5),
        "p * q": (-3.0, 6.0, -3.0),
        "-p": (-1.0, -2.0, -3.0),
        "+p": (1.0, 2.0, 3.0),
        "both.place": (1.0, 2.0, 3.0),
        "[n, n + 1, row{3}]": (3.0, 4.0, 4.0),
    },
    "orient": {"o * o": (-1.0, 0.0, 0.0, 0.0)},
    "pair": {"[n, q]": (3.0, (4.0, 5.0, 6.0))},
}
UNKNOWN: Mapping[str, Mapping[str, str]] = {
    "num": {
        "asked": NOT_STATIC.reason,
        "asked + 1": NOT_STATIC.reason,
        "1 + asked": NOT_STATIC.reason,
        "-asked": NOT_STATIC.reason,
        "row{asked}": NOT_STATIC.reason,
        "row{0}": "there is no element 0",
        "row{n + 1}": "there is no element 4",
        "row{1.5}": "there is no element 1.5",
        "n / 0": "it divides by zero",
        "n DIV 0": "it fails: 3 DIV 0",
        "n MOD 0": "it fails: 3 MOD 0",
        "1E30 * 1E30": "it fails: the result 1e+60 is beyond the range of num, ±3.40282E+38",
        "Abs(-1)": NOT_STATIC.reason,
    },
    "dnum": {"1E300 * 1E300": "it fails: the result INF is too large"},
    "bool": {
        "yes AND hidden": NOT_STATIC.reason,
        "no OR hidden": NOT_STATIC.reason,
        "hidden AND no": NOT_STATIC.reason,
        "row = row": NOT_STATIC.reason,
    },
    "pos": {
        "[1, asked, n / 0]": NOT_STATIC.reason,
        "p / 0": "it fails: a position divided by 0",
    },
    "string": {f'"{"a" * 80}" + "b"': "it fails: the string has 81 characters, 80 are allowed"},
}


def declared(of: str, expressions: Mapping[str, object]) -> str:
    """A module with a variable for each expression, which a run assigns."""
    data = "".join(f"VAR {of} r{n};" for n, _ in enumerate(expressions))
    return main("\n".join(f"r{n} := {e};" for n, e in enumerate(expressions)), DATA + data)


def known(program: Program) -> list[Known]:
    """The values of what main assigns, without a run."""

    def read(reference: tree.DataReference) -> Known:
        symbol = program.symbol_of[reference]
        if not isinstance(symbol, DataSymbol) or symbol.node is None or symbol.node.value is None:
            return NOT_STATIC
        return evaluator.value(symbol.node.value, symbol.type)

    evaluator = Evaluator(program, read)
    (routine,) = program.modules[0].routines
    return [evaluator.value(one.value) for one in routine.body if isinstance(one, tree.Assignment)]


@pytest.mark.parametrize("of", VALUES)
def test_values_of_each_type_are_those_of_a_run(of: str) -> None:
    text = declared(of, VALUES[of])
    ran = run(text)
    assert ran.fatal is None
    expected = list(VALUES[of].values())
    assert known(checked(text)) == expected
    assert [ran.task.value(f"r{n}") for n, _ in enumerate(expected)] == expected


@pytest.mark.parametrize("of", UNKNOWN)
def test_a_value_is_unknown_for_a_reason(of: str) -> None:
    found = known(checked(declared(of, UNKNOWN[of])))
    assert found == [NotStatic(reason) for reason in UNKNOWN[of].values()]
