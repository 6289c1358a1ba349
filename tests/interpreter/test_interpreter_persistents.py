"""Which parameters may stand for a persistent: whoever waits for its change must not miss one."""

from __future__ import annotations

from dataclasses import dataclass, field
from unittest import mock

import pytest
from hypothesis import given
from hypothesis import strategies as st
from interpreter_cell import RecordingController, checked, main, module
from laws import examples

from rapidsim.analysis.program import Program, RoutineSymbol
from rapidsim.interpreter.codegen.persistent_parameters import persistent_parameters
from rapidsim.interpreter.linking import translation
from rapidsim.interpreter.linking.loader import Task, load
from rapidsim.interpreter.linking.translation import show_python
from rapidsim.interpreter.tools.expression_queries import answers, check_query
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.controller import uniform_controller
from rapidsim.syntax import tree

DATA = "PERS num kept := 1; PERS num kepts{2} := [1, 2]; VAR num own; VAR num owns{2};"
ROUTINES = """
PROC first(INOUT num a) second a, 1; ENDPROC
PROC second(INOUT num b, num by) b := b + by; ENDPROC
PROC either(\\INOUT num c) IF Present(c) c := 1; third \\d?c; ENDPROC
PROC third(\\INOUT num d) ENDPROC
PROC always(PERS num e) e := 1; ENDPROC
PROC never(VAR num f) f := 1; ENDPROC
"""


def found(statements: str) -> set[str]:
    """The names of the parameters that may be one."""
    nodes = persistent_parameters(checked(main(statements, DATA, ROUTINES)))
    return {node.name.text for node in nodes if isinstance(node, tree.ParameterDeclaration)}


@pytest.mark.parametrize(
    ("statements", "expected"),
    [
        ("first own; second owns{2}, kept; never own;", "e"),
        ("first kept;", "a b e"),
        ("second kepts{1}, 1;", "b e"),
        ("either \\c:=kept;", "c d e"),
        ("third \\d:=kept;", "d e"),
        ('%"always"% kept;', "a b c d e"),
        ('%"main"%;', "e"),
        ('Load "HOME:/more.mod";', "a b c d e"),
    ],
)
def test_parameters(statements: str, expected: str) -> None:
    assert found(statements) == set(expected.split())


@pytest.mark.parametrize(("lent", "is_asked"), [("own", False), ("kept", True)])
def test_only_there_is_it_asked_for(lent: str, is_asked: bool) -> None:
    adds = "PROC add(INOUT num a) a := a + 1; ENDPROC"
    assert ("watches" in show_python(checked(main(f"add {lent};", DATA, adds)))) is is_asked


@dataclass
class Waiting(RecordingController):
    """Notes how the persistents have changed, each time it is asked to look."""

    watches: bool = True
    task: Task | None = None
    changes: list[object] = field(default_factory=list)

    def serve_persistent_changes(self) -> None:
        assert self.task is not None
        now = self.task.value("kept"), self.task.value("kepts")
        if self.changes[-1:] != [now]:
            self.changes.append(now)


def changes(text: str) -> list[object]:
    controller = Waiting()
    controller.task = load(checked(text), uniform_controller(controller))
    controller.serve_persistent_changes()
    controller.task.run()
    return controller.changes


data = st.sampled_from(["x", "own", "owns{1}", "kept", "kepts{2}", "x", "own"])


def routine(number: int) -> st.SearchStrategy[str]:
    """Calls only those with higher numbers, so it comes to an end."""
    later = st.integers(number + 1, 4)
    statement = st.one_of(
        data.map(lambda one: f"{one} := {one} + {number + 1};"),
        st.sampled_from(["x", "own", "kept"]).map(lambda one: f"Incr {one};"),
        st.tuples(later, data).map(lambda t: f"r{t[0]} {t[1]};"),
        st.tuples(later, data).map(lambda t: f"late {t[0]}, {t[1]};"),
    )
    called = st.lists(statement, min_size=1, max_size=3).map(" ".join)
    return called.map(lambda body: f"PROC r{number}(INOUT num x) {body} ENDPROC")


def every(program: Program) -> frozenset[tree.Node]:
    """As if nothing were known."""
    routines = [program.symbol_of[one] for module in program.modules for one in module.routines]
    return frozenset(
        parameter.node
        for one in routines
        if isinstance(one, RoutineSymbol)
        for parameter in one.parameters
        if parameter.mode in (ParameterMode.INOUT, ParameterMode.PERS)
    )


@examples(100)
@given(st.tuples(*(routine(number) for number in range(4))), data, st.booleans())
def test_no_change_is_missed(routines: tuple[str, ...], first: str, by_name: bool) -> None:
    late = '%"r" + ValToStr(n)% y;' if by_name else "TEST n CASE 4: r4 y; DEFAULT: Incr y; ENDTEST"
    text = module(
        f"PROC main() VAR num x; r0 {first}; r1 x; ENDPROC {' '.join(routines)} "
        "PROC r4(INOUT num x) x := 2 * x; ENDPROC "
        f"PROC late(num n, INOUT num y) {late} ENDPROC",
        DATA,
    )
    known = changes(text)
    with mock.patch.object(translation, "persistent_parameters", every):
        assert known == changes(text)


def test_a_question_may_lend_a_persistent() -> None:
    """The routines that it calls are made anew for it."""
    function = "FUNC num more(INOUT num x) x := x + 1; RETURN x; ENDFUNC"
    controller = Waiting()
    controller.task = load(
        checked(main("own := more(own);", DATA, function)), uniform_controller(controller)
    )
    controller.task.run()
    assert not controller.changes
    asked = check_query("more(kept) = 2", "question", controller.task.program, ())
    assert asked.question is not None
    (answer,) = answers(controller.task, [asked.question], {})
    assert answer.error is None, answer.error
    assert controller.changes
