"""Rules F402, F403, F409 and F423: constant conditions, endless loops, TEST and its cases."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import may_do
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.analysis.tree_walk import blocks, clauses, descendants, statements
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_LEAVES = (tree.Return, tree.Exit, tree.Goto, tree.Raise, tree.LateCall, tree.InvalidStatement)


class ConstantCondition(Violation, code="F402"):
    value: str


class EndlessLoop(Violation, code="F403"):
    pass


class NotBeforeAnd(Violation, code="F417"):
    written: str
    meant: str


class TestWithoutDefault(Violation, code="F409"):
    pass


class DuplicateCase(Violation, code="F423"):
    value: str


def find_duplicate_cases(facts: Facts) -> Iterator[Diagnostic]:
    """Report values of a CASE that an earlier CASE of the same TEST has."""
    for part in facts.parts:
        for test in part.all(tree.Test):
            first: dict[object, tree.Expression] = {}
            for value in (value for case in test.cases for value in case.values):
                known = known_value(value, facts, persistents=False)
                if known is None:
                    continue
                earlier = first.setdefault(known, value)
                if earlier is not value:
                    shown = part.module.span(value).one_line
                    related = part.place(earlier, "the first one, which is executed")
                    yield part.finding(DuplicateCase(shown), value, related)


def find_constant_conditions(facts: Facts) -> Iterator[Diagnostic]:
    """Report conditions of IF and WHILE that consist of literals only."""
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
    """Report WHILE TRUE, and jumps back, whose statements neither take time nor leave."""
    for part in facts.parts:
        for loop in part.all(tree.While):
            if _literal_truth(loop.condition) and not _takes_time(loop.body, facts):
                keyword = tree.Node(loop.start, loop.condition.end)
                yield part.finding(EndlessLoop(), keyword)
        for jump, body in _jumps_back(part):
            if not _takes_time(body, facts):
                yield part.finding(EndlessLoop(), jump)


def find_not_before_and(facts: Facts) -> Iterator[Diagnostic]:
    """Report NOT before an AND without parentheses: it negates the whole conjunction."""
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
    """Report TEST statements without DEFAULT."""
    for part in facts.parts:
        for test in part.all(tree.Test):
            if test.default is None:
                head = tree.Node(test.start, test.subject.end)
                yield part.finding(TestWithoutDefault(), head)


def _literal_truth(condition: tree.Expression) -> bool | None:
    """Whether a condition of literals holds; None if it is not made of literals."""
    match condition:
        case tree.BoolLiteral(value=value):
            return value
        case tree.Parenthesised(inner=inner):
            return _literal_truth(inner)
        case tree.Unary(operator="NOT", operand=operand):
            inner_truth = _literal_truth(operand)
            return None if inner_truth is None else not inner_truth
        case tree.Binary(
            left=tree.NumberLiteral(value=a), operator=operator, right=tree.NumberLiteral(value=b)
        ):
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


def _jumps_back(part: ProgramPart) -> Iterator[tuple[tree.Goto, tree.Body]]:
    """Yield each GOTO that always follows its label, with the statements in between.

    Both are in one list of statements, so execution that passes the label reaches the jump.
    """
    if part.routine is None or not part.all(tree.Goto):
        return
    bodies = list(clauses(part.routine))
    for statement in statements(*bodies):
        bodies += blocks(statement)
    for body in bodies:
        behind: dict[str, int] = {}
        for position, statement in enumerate(body):
            if isinstance(statement, tree.Label):
                behind[statement.name.key] = position + 1
            elif isinstance(statement, tree.Goto) and statement.name.key in behind:
                yield statement, body[behind[statement.name.key] : position]


def _takes_time(body: tree.Body, facts: Facts) -> bool:
    """Whether something in a loop moves, waits, leaves it, or may do so."""
    for node in descendants(*body):
        match node:
            case tree.Call():
                # A loop of calls that take no time keeps the task busy.
                if Trait.INSTANT not in may_do(node, facts):
                    return True
            case tree.FunctionCall():
                if facts.installed(node) is None or Trait.WAIT in facts.does(node):
                    return True
            case tree.DataReference():
                # Undeclared names may have any effect.
                if facts.symbol(node) is None:
                    return True
            case _ if isinstance(node, _LEAVES):
                return True
            case _:
                continue
    return False
