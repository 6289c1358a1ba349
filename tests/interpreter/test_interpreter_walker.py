"""Generated code and a naive tree walker leave the same memory behind."""

from __future__ import annotations

import execution
from hypothesis import given
from hypothesis import strategies as st
from interpreter_cell import module, run
from interpreter_walker import Failed, Returned, Slot, Walker
from laws import examples

from rapidsim.diagnostics import Source
from rapidsim.syntax.parser import parse

NAMES = ("x", "y", "z")
DATA = "VAR num x; VAR num y; VAR num z; VAR num a{3} := [1, 2, 3]; VAR bool b;"

literals = st.sampled_from(["0", "1", "2", "3", "0.1", "2.5", "16777216", "7", "1E30"])
atoms = st.one_of(literals, st.sampled_from([*NAMES, "i", "a{1}", "a{3}", "own"]))


def arithmetic(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    operators = st.sampled_from(["+", "-", "*", "/", "DIV", "MOD"])
    binary = st.tuples(children, operators, children).map(lambda t: f"({t[0]} {t[1]} {t[2]})")
    return st.one_of(binary, children.map(lambda e: f"(-{e})"), children.map(lambda e: f"a{{{e}}}"))


nums = st.recursive(atoms, arithmetic, max_leaves=5)
comparisons = st.tuples(nums, st.sampled_from(["=", "<>", "<", "<=", ">", ">="]), nums).map(
    lambda t: f"({t[0]} {t[1]} {t[2]})"
)


def logic(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    binary = st.tuples(children, st.sampled_from(["AND", "OR", "XOR"]), children)
    return st.one_of(
        binary.map(lambda t: f"({t[0]} {t[1]} {t[2]})"), children.map(lambda e: f"(NOT {e})")
    )


bools = st.recursive(st.one_of(comparisons, st.just("b")), logic, max_leaves=3)
simple = st.one_of(
    st.tuples(st.sampled_from([*NAMES, "own", "a{1}"]), nums).map(lambda t: f"{t[0]} := {t[1]};"),
    st.tuples(nums, nums).map(lambda t: f"a{{{t[0]}}} := {t[1]};"),
    bools.map(lambda e: f"b := {e};"),
    st.tuples(st.sampled_from([*NAMES, "own"]), nums).map(lambda t: f"bump {t[0]}, {t[1]};"),
    st.just("RETURN;"),
)


def compound(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    body = st.lists(children, min_size=1, max_size=3).map(" ".join)
    small = st.sampled_from(["1 TO 3", "3 TO 1", "1 TO x MOD 4", "0.5 TO 2 STEP 0.5", "x TO x"])
    return st.one_of(
        st.tuples(bools, body, bools, body, body).map(
            lambda t: f"IF {t[0]} THEN {t[1]} ELSEIF {t[2]} THEN {t[3]} ELSE {t[4]} ENDIF"
        ),
        st.tuples(bools, simple).map(lambda t: f"IF {t[0]} {t[1]}"),
        st.tuples(small, body).map(lambda t: f"FOR i FROM {t[0]} DO {t[1]} ENDFOR"),
        st.tuples(nums, nums, nums, body, body).map(
            lambda t: f"TEST {t[0]} CASE {t[1]}, {t[2]}: {t[3]} DEFAULT: {t[4]} ENDTEST"
        ),
        # The counter of the loop is nobody else's, so it ends.
        body.map(
            lambda b: (
                f"turns := 0; WHILE turns < 3 AND 1 / y <> 0 DO turns := turns + 1; {b} "
                "turns := turns + 1; ENDWHILE"
            )
        ),
    )


statements = st.lists(st.recursive(simple, compound, max_leaves=6), min_size=1, max_size=4)
handlers = st.sampled_from(
    [
        "",
        "ERROR y := y + 1; TRYNEXT;",
        "ERROR y := y + 1; x := 1; z := 1; own := 2; RETRY;",
        "ERROR",
    ]
)


@examples(150)
@given(statements, handlers)
def test_both_leave_the_same_memory(body: list[str], handler: str) -> None:
    text = module(
        f"PROC main() VAR num own; FOR i FROM 2 TO 2 DO {' '.join(body)} ENDFOR z := z + own;\n"
        f"{handler} ENDPROC\n"
        "PROC bump(INOUT num v, num by) v := v + by; v := v * 2; ENDPROC",
        DATA + "VAR num turns;",
    )
    # A name in a FOR that counts i hides the outer one; the same holds in the walker.
    (tree_module,) = parse(Source("cell.mod", text)).file.modules
    walker = Walker(tree_module)
    walker.memory = {name: Slot(0.0) for name in (*NAMES, "turns")}
    walker.memory |= {"a": Slot([1.0, 2.0, 3.0]), "b": Slot(False)}
    failed = False
    try:
        walker.call("main", [])
    except Failed:
        failed = True
    except Returned:
        pass
    ran = run(text)
    assert (ran.fatal is not None) == failed, ran.fatal and ran.fatal.error.message
    found = {name: ran.task.value(name) for name in walker.memory}
    assert found == {name: slot.value for name, slot in walker.memory.items()}


def test_the_loops_that_are_measured_compute_the_same() -> None:
    # Generated code and closures of the benchmark; it raises where their memory differs.
    assert set(execution.loop_times(1)) == set(execution.LOOPS)
