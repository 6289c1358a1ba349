"""Laws: no text makes the check raise, and a program is given exactly where nothing forbids it."""

from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st
from laws import cases

from rapidsim.analysis.passes.checker import CheckOutcome, check
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.analysis.suggestions import closest, reserved_words
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Severity, Source
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse

PROGRAMS = sorted((Path(__file__).parent / "programs").glob("*.mod"))
TEXTS = [path.read_text(encoding="utf-8") for path in PROGRAMS]
TOKENS = st.sampled_from(
    [
        *reserved_words(),
        *("a", "b", "p10", "num", "dnum", "robtarget", "MoveL", "Offs", "SetDO", "reg1", "v100"),
        *(":=", "=", "<>", "<", "+", "-", "*", "/", "(", ")", "{", "}", "[", "]", ",", ";", ":"),
        *("\\", "?", "|", "%", ".", "1", "0", "2.5", "1E400", '"text"', "<SMT>", "<EXP>", "\n"),
    ]
)
LAW = settings(max_examples=cases(150))

EVERY_RULE = detectors_of(lambda rule: True)


def checked(text: str) -> CheckOutcome:
    return check([parse(Source("any.mod", text)).file], EVERY_RULE)


def is_without_error(found: CheckOutcome) -> bool:
    return all(one.severity is not Severity.ERROR for one in found.diagnostics)


@LAW
@given(st.lists(TOKENS, max_size=60))
def test_no_soup_of_tokens_makes_check_raise(tokens: list[str]) -> None:
    body = " ".join(tokens)
    for text in (body, f"MODULE m\n{body}\nENDMODULE", f"MODULE m\nPROC main()\n{body}\nENDPROC"):
        found = checked(text)
        assert found.program is None or is_without_error(found)


@LAW
@given(st.data())
def test_no_damaged_program_makes_check_raise(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(TEXTS))
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, min(len(text), start + 40)))
    put = data.draw(st.lists(TOKENS, max_size=3))
    checked(text[:start] + " ".join(put) + text[end:])


def test_long_and_deep_expressions_are_checked() -> None:
    sums = "+".join(["1"] * 5000)
    signs = "-" * 150 + "1"
    nested = "(" * 150 + "1" + ")" * 150
    body = f"a:={sums};\na:=1+{signs};\na:={nested};"
    text = f"MODULE m\nVAR num a;\nPROC main()\n{body}\nENDPROC\nENDMODULE"
    assert checked(text).program is not None


def test_every_expression_of_a_program_has_a_type() -> None:
    """What the interpreter may look up is there."""
    expressions = (
        *(
            tree.NumberLiteral,
            tree.StringLiteral,
            tree.BoolLiteral,
            tree.Unary,
            tree.Binary,
            tree.Parenthesised,
        ),
        *(tree.FunctionCall, tree.Aggregate, tree.LiteralAggregate),
    )
    seen = 0
    for text in TEXTS:
        file = parse(Source("any.mod", text)).file
        program = check([file]).program
        if program is None:
            continue
        seen += 1
        for module in file.modules:
            for node in descendants(*module.items):
                if isinstance(node, expressions) and node not in program.type_of:
                    raise AssertionError(f"{module.span(node).text} has no type")
                if isinstance(node, tree.DataReference | tree.Call | tree.FunctionCall):
                    assert node in program.symbol_of, module.span(node).text
    assert seen


@given(st.text("abcdefgh_0123456789", min_size=1, max_size=12))
def test_nothing_is_nearest_to_itself(name: str) -> None:
    assert closest(name, [name]) is None
