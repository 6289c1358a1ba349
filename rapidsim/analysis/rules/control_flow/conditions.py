"""Rules F402, F403 and F409: constant conditions, endless loops, TEST without DEFAULT."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts, Part
from rapidsim.analysis.rules.facts.instruction_questions import may_do
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Violation
from rapidsim.library.traits import Does
from rapidsim.syntax import tree

_LEAVES = (tree.Return, tree.Exit, tree.Goto, tree.Raise, tree.LateCall, tree.Broken)


class ConstantCondition(Violation, code="F402"):
    value: str


class EndlessLoop(Violation, code="F403"):
    pass


class NotBeforeAnd(Violation, code="F417"):
    written: str
    meant: str


class TestWithoutDefault(Violation, code="F409"):
    pass


def find_constant_conditions(facts: Facts) -> Iterator[Diagnostic]:
    """Conditions of IF and WHILE that are made of literals alone."""
    for part in facts.parts:
        conditions = [
            *(node.condition for node in part.all(tree.Branch)),
            *(node.condition for node in part.all(tree.CompactIf)),
            *(node.condition for node in part.all(tree.While)),
        ]
        endless = {node.condition for node in part.all(tree.While)}
        for condition in conditions:
            value = _literal_truth(condition)
            if value is None or (value and condition in endless):
                continue
            yield part.finding(ConstantCondition("TRUE" if value else "FALSE"), condition)


def find_endless_loops(facts: Facts) -> Iterator[Diagnostic]:
    """WHILE TRUE with nothing in it that takes time or leaves."""
    for part in facts.parts:
        for loop in part.all(tree.While):
            if _literal_truth(loop.condition) and not _takes_time(loop, part, facts):
                keyword = tree.Node(loop.start, loop.condition.end)
                yield part.finding(EndlessLoop(), keyword)


def find_not_before_and(facts: Facts) -> Iterator[Diagnostic]:
    """NOT before an AND without parentheses: it negates the whole."""
    for part in facts.parts:
        for node in part.all(tree.Unary):
            inner = node.operand
            if (
                node.operator == "NOT"
                and isinstance(inner, tree.Binary)
                and inner.operator == "AND"
            ):
                source = part.module.source
                text = source.text
                first = _first_of_and(inner)
                written = " ".join(text[inner.start : inner.end].split())
                negated = " ".join(text[first.start : first.end].split())
                meant = f"({' '.join(text[node.start : first.start].split())} {negated})"
                cure = Edit(part.module.span(tree.Node(node.start, first.end)), meant)
                fix = Fix("NOT for the first one only", (cure,), safe=False)
                yield part.finding(NotBeforeAnd(written, meant), node, fix=fix)


def _first_of_and(conjunction: tree.Binary) -> tree.Expression:
    left = conjunction.left
    while isinstance(left, tree.Binary) and left.operator == "AND":
        left = left.left
    return left


def find_tests_without_default(facts: Facts) -> Iterator[Diagnostic]:
    """TEST statements without DEFAULT."""
    for part in facts.parts:
        for test in part.all(tree.Test):
            if test.default is None:
                head = tree.Node(test.start, test.subject.end)
                yield part.finding(TestWithoutDefault(), head)


def _literal_truth(condition: tree.Expression) -> bool | None:
    """Whether a condition of literals holds; None where it holds anything else."""
    match condition:
        case tree.Bool(value=value):
            return value
        case tree.Parenthesised(inner=inner):
            return _literal_truth(inner)
        case tree.Unary(operator="NOT", operand=operand):
            inner_truth = _literal_truth(operand)
            return None if inner_truth is None else not inner_truth
        case tree.Binary(left=tree.Number(value=a), operator=operator, right=tree.Number(value=b)):
            compared = {
                "=": a == b,
                "<>": a != b,
                "<": a < b,
                ">": a > b,
                "<=": a <= b,
                ">=": a >= b,
            }
            return compared.get(operator)
        case _:
            return None


def _takes_time(loop: tree.While, part: Part, facts: Facts) -> bool:
    """Whether something in a loop moves, waits, leaves it, or may do so."""
    for node in descendants(*loop.body):
        match node:
            case tree.Call():
                # A loop of nothing that takes time keeps the task busy.
                if Does.INSTANT not in may_do(node, facts):
                    return True
            case tree.FunctionCall():
                if facts.installed(node) is None or Does.WAIT in facts.does(node):
                    return True
            case tree.Reference():
                # What nothing declares may be anything.
                if facts.symbol(node) is None:
                    return True
            case _ if isinstance(node, _LEAVES):
                return True
            case _:
                continue
    return False
