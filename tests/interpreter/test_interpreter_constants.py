"""Constants: what a check knows without a run is what the run computes, bit for bit."""

from hypothesis import given
from hypothesis import strategies as st
from interpreter_cell import checked, main, texts
from laws import examples

from rapidsim.analysis.evaluation import NOT_STATIC, Evaluator, NotStatic
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
