"""The control-flow graph: its shape, and laws that hold for any program.

A graph is drawn as one line a block that control can enter: its steps, then its edges.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import some

from rapidsim.analysis import program
from rapidsim.analysis.flow.build import build_graph
from rapidsim.analysis.flow.graph import (
    ENDED,
    ENTRY,
    EXIT,
    NORMAL,
    RAISED,
    ControlFlowGraph,
    EdgeKind,
)
from rapidsim.analysis.flow.solve import forward
from rapidsim.analysis.flow.summaries import components, summarise
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.diagnostics import Source
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.check_files import check_tasks
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.traits import NO_TRAITS, Trait
from rapidsim.module_files import TaskFiles
from rapidsim.motion.robot.robot import load_robot
from rapidsim.reach.reach import check_reach
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse

PROGRAMS = sorted(Path(__file__).parent.parent.rglob("*.mod"))
NAMES = {EXIT: "EXIT", RAISED: "RAISED", ENDED: "ENDED"}


def traits_of(call: tree.Call) -> Trait:
    routine = ROUTINES.get(call.name.key)
    return NO_TRAITS if routine is None else routine.traits


def graph(body: str) -> tuple[ControlFlowGraph, tree.Module]:
    parsed = parse(Source("m.mod", f"MODULE m\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"))
    (module,) = parsed.file.modules
    return build_graph(module.routines[0], traits_of), module


def drawn(body: str) -> list[str]:
    """The blocks that control can enter, in the order of the text."""
    flow, module = graph(body)
    reached = flow.reached(sum(EdgeKind), flow.entries)
    lines = []
    for index in sorted(reached - NAMES.keys()):
        block = flow.blocks[index]
        steps = "; ".join(
            " ".join(module.span(step).text.rstrip(";").split()) for step in block.steps
        )
        edges = " ".join(
            f"{edge.kind.name}{'' if edge.holds is None else f'({edge.holds})'}"
            f">{NAMES.get(edge.to, edge.to)}"
            for edge in block.edges
        )
        lines.append(f"{index}: {steps} -> {edges}")
    return lines


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("a; RETURN; b;", ["0: a; RETURN -> RETURN>EXIT"]),
        (
            "IF x a;",
            [
                "0: x -> NEXT(True)>4 NEXT(False)>5",
                "4: a -> NEXT>6",
                "5:  -> NEXT>6",
                "6:  -> RETURN>EXIT",
            ],
        ),
        (
            "WHILE x DO a; ENDWHILE",
            [
                "0: x -> NEXT(True)>5 NEXT(False)>6",
                "4: x -> NEXT(True)>5 NEXT(False)>6",
                "5: a -> BACK>4",
                "6:  -> RETURN>EXIT",
            ],
        ),
        (
            "WHILE TRUE DO a; ENDWHILE b;",
            ["0: TRUE -> NEXT(True)>5", "4: TRUE -> NEXT(True)>5", "5: a -> BACK>4"],
        ),
        ("again: a; GOTO again;", ["0:  -> NEXT>4", "4: a -> JUMP>4"]),
        ("a; ExitCycle; b;", ["0: a; ExitCycle -> NEXT>ENDED"]),
        ("RAISE 5;", ["0: RAISE 5 -> NEXT>RAISED"]),
        (
            "a; ERROR TRYNEXT;",
            ["0: a -> NEXT>4 ERROR>5 TRYNEXT>4", "4:  -> RETURN>EXIT", "5:  -> "],
        ),
        ("x := f(g(1));", ["0: f(g(1)); g(1); x := f(g(1)) -> RETURN>EXIT"]),
        (
            "a; <SMT> b;",
            [
                "0: a; <SMT> -> UNREAD>4 UNREAD>5",
                "4: b -> RETURN>EXIT",
                "5:  -> UNREAD>EXIT",
            ],
        ),
        (
            "TEST x CASE 1: a; DEFAULT: RETURN; ENDTEST b;",
            [
                "0: x; 1 -> NEXT>4 NEXT>5",
                "4: a -> NEXT>7",
                "5: RETURN -> RETURN>EXIT",
                "7: b -> RETURN>EXIT",
            ],
        ),
    ],
)
def test_the_graph_of_each_statement(body: str, expected: list[str]) -> None:
    assert drawn(body) == expected


def test_every_statement_of_every_program_begins_a_step_of_one_block() -> None:
    count = 0
    for path in some(PROGRAMS, 8):
        text = path.read_bytes().decode("utf-8", errors="replace")
        for module in parse(Source(path.name, text)).file.modules:
            for routine in module.routines:
                flow = build_graph(routine, traits_of)
                for statement in statements(*clauses(routine)):
                    assert 0 <= flow.block_of[statement] < len(flow.blocks)
                    count += 1
                for block in flow.blocks:
                    assert all(0 <= edge.to < len(flow.blocks) for edge in block.edges)
    assert count


def test_a_loop_is_what_leads_back_to_its_first_block() -> None:
    flow, module = graph("a; here: b; IF x THEN c; ELSE RETURN; ENDIF IF y GOTO here; d;")
    inside = {module.span(one).text for one in flow.block_of if flow.block_of[one] in loop(flow)}
    assert {"here:", "b", "c"} <= inside
    assert not {"a", "RETURN", "d"} & inside


def test_a_loop_with_two_entries_is_none() -> None:
    flow, _ = graph("IF x GOTO middle; here: b; middle: c; IF y GOTO here;")
    assert flow.loop(*head_and_ends(flow)) is None


def head_and_ends(flow: ControlFlowGraph) -> tuple[int, list[int]]:
    """The first label's block, and the blocks with a jump back to it."""
    label = min((one for one in flow.block_of if isinstance(one, tree.Label)), key=start_of)
    head = flow.block_of[label]
    return head, [
        index
        for index, block in enumerate(flow.blocks)
        for edge in block.edges
        if edge.to == head and edge.kind == EdgeKind.JUMP
    ]


def loop(flow: ControlFlowGraph) -> set[int]:
    found = flow.loop(*head_and_ends(flow))
    assert found is not None
    return found


def start_of(node: tree.Node) -> int:
    return node.start


def test_a_check_with_a_run_builds_each_graph_once(monkeypatch: pytest.MonkeyPatch) -> None:
    built: list[tree.Routine] = []

    def counted(routine: tree.Routine, *others: Any) -> ControlFlowGraph:
        built.append(routine)
        return build_graph(routine, *others)

    monkeypatch.setattr(program, "build_graph", counted)
    text = Path("programs/algorithms.mod").read_text()
    check_tasks(
        [TaskFiles("T_ROB1", (SourceFile("m.mod", text, "utf-8"),))],
        moves=lambda checked, _, *, runs: check_reach(checked, load_robot("irb1600"), run=runs),
    )
    assert built
    assert len(set(built)) == len(built)


CALLS = st.dictionaries(st.integers(0, 9), st.frozensets(st.integers(0, 9), max_size=4))


def reachable(calls: Mapping[int, frozenset[int]], start: int) -> set[int]:
    """What a routine calls, directly or not."""
    seen: set[int] = set()
    stack = [*calls.get(start, ())]
    while stack:
        routine = stack.pop()
        if routine not in seen:
            seen.add(routine)
            stack += calls.get(routine, ())
    return seen


@given(CALLS)
def test_components_are_the_routines_that_call_each_other(
    calls: dict[int, frozenset[int]],
) -> None:
    routines = range(10)
    found = components(routines, lambda one: calls.get(one, frozenset()))
    assert sorted(one for component in found for one in component) == list(routines)
    place = {one: at for at, component in enumerate(found) for one in component}
    for one in routines:
        for other in reachable(calls, one):
            # Callees first; the same component if each reaches the other.
            assert place[other] <= place[one]
            assert (place[other] == place[one]) is (one == other or one in reachable(calls, other))


@given(CALLS)
def test_summaries_are_the_least_fixed_point(calls: dict[int, frozenset[int]]) -> None:
    found = summarise(
        range(10),
        lambda one: calls.get(one, frozenset()),
        frozenset[int](),
        lambda one, known: frozenset({one}).union(*(known[c] for c in calls.get(one, ()))),
    )
    assert found == {one: frozenset({one, *reachable(calls, one)}) for one in range(10)}


BODIES = st.recursive(
    st.sampled_from(["a;", "RETURN;", "GOTO here;", "here:", "EXIT;", "RAISE 1;", "b := f(1);"]),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3).map(" ".join),
        inner.map(lambda body: f"IF x THEN {body} ENDIF"),
        inner.map(lambda body: f"WHILE x DO {body} ENDWHILE"),
        inner.map(lambda body: f"FOR i FROM 1 TO 3 DO {body} ENDFOR"),
        inner.map(lambda body: f"TEST x CASE 1: {body} DEFAULT: a; ENDTEST"),
    ),
    max_leaves=12,
)


@given(BODIES)
def test_a_worklist_reaches_what_a_search_reaches(body: str) -> None:
    flow, _ = graph(body)
    states = forward(flow, {ENTRY: True}, lambda _, state: state, lambda one, other: one or other)
    assert states.keys() == flow.reached(NORMAL)


@given(BODIES)
def test_states_count_the_paths_of_a_chain(body: str) -> None:
    """The set of steps on some path to a block contains those of its predecessors."""
    flow, _ = graph(body)

    def after(node: tree.Node, state: frozenset[int]) -> frozenset[int]:
        return state | {node.start}

    states = forward(flow, {ENTRY: frozenset[int]()}, after, frozenset.union)
    for index, state in states.items():
        end = state | {node.start for node in flow.blocks[index].steps}
        for edge in flow.blocks[index].edges:
            assert not edge.kind & NORMAL or end <= states[edge.to]
