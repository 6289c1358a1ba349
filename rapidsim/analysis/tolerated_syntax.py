"""Non-RAPID syntax that the parser accepts: one finding for each mark on the tree."""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.analysis.context import Context
from rapidsim.analysis.syntax_violations import (
    ArrayComponent,
    CallInParentheses,
    CaseRange,
    EmptyRecord,
    EqualsForAssignment,
    LateBoundFunction,
    MissingParameterList,
    MissingWord,
    SignInside,
    UnfinishedCode,
    UnfinishedDeclaration,
)
from rapidsim.analysis.tree_walk import NodesByKind
from rapidsim.diagnostics import Edit, Fix
from rapidsim.syntax import tree

# Placeholders of declarations; the others replace statements, expressions and arguments.
_DECLARATIONS = frozenset({"TDN", "DDN", "RDN", "PAR", "ALT", "DIM"})
_MARKS: Mapping[type[tree.Node], str | None] = {
    tree.Assignment: "equals_sign",
    tree.Data: "equals_sign",
    tree.Call: "in_parentheses",
    tree.Branch: "then_missing",
    tree.While: "do_missing",
    tree.Case: "range_to",
    tree.LateFunctionCall: None,
    tree.Unary: "not_after_operator",
    tree.ComponentDeclaration: "dimensions",
    tree.RecordType: None,
    tree.Proc: "parentheses_missing",
    tree.Func: "parentheses_missing",
    tree.Placeholder: None,
}
"""The fields that mark nodes, by class; None if each node is examined."""


def _check_equals_sign(node: tree.Assignment | tree.Data, context: Context) -> None:
    match node:
        case tree.Assignment(operator_start=sign, target=target):
            written, place = _text(context, target), tree.Node(sign, sign + 1)
        case tree.Data(value=tree.Node() as value) if node.name.text:
            sign = context.module.source.text.rfind("=", node.name.end, value.start)
            written, place = node.name.text, node
        case _:
            # Without a name the declaration has been reported.
            return
    fix = _replacement(context, sign, sign + 1, ":=")
    context.report(EqualsForAssignment(written), place, fix=fix)


def check_lenient_marks(nodes: NodesByKind, context: Context) -> None:
    """Report every lenient mark and placeholder among nodes of a module, listed by class."""
    text = context.module.source.text
    marked = [
        node
        for kind, mark in _MARKS.items()
        for node in nodes.all(kind)
        if mark is None or getattr(node, mark)
    ]
    for node in sorted(marked, key=lambda node: (node.start, -node.end)):
        match node:
            case tree.Assignment(equals_sign=True) | tree.Data(equals_sign=True):
                _check_equals_sign(node, context)
            case tree.Call(in_parentheses=True):
                fix = _without_parentheses(context, node)
                context.report(CallInParentheses(node.name.text), node, fix=fix)
            case tree.Branch(then_missing=True):
                end = node.condition.end
                fix = _replacement(context, end, end, " THEN")
                context.report(MissingWord("ELSEIF", "THEN"), node.condition, fix=fix)
            case tree.While(do_missing=True):
                end = node.condition.end
                fix = _replacement(context, end, end, " DO")
                context.report(MissingWord("WHILE", "DO"), node.condition, fix=fix)
            case tree.Case(range_to=tree.Node() as last):
                context.report(CaseRange(), tree.Node(node.values[0].start, last.end))
            case tree.LateFunctionCall():
                context.report(LateBoundFunction(), node)
            case tree.Unary(operator="+" | "-", not_after_operator=True):
                context.report(SignInside(node.operator), node)
            case tree.ComponentDeclaration(dimensions=(_, *_)):
                context.report(ArrayComponent(node.name.text), node)
            case tree.RecordType(components=()):
                context.report(EmptyRecord(node.name.text), node.name)
            case tree.Proc(parentheses_missing=True) | tree.Func(parentheses_missing=True) if (
                node.name.text  # Without a name the whole header has been reported.
            ):
                end = node.name.end
                fix = _replacement(context, end, end, "()")
                context.report(MissingParameterList(node.name.text), node.name, fix=fix)
            case tree.Placeholder() if text[node.start : node.start + 1] not in ("<", "*"):
                # Inserted by the parser for unreadable text, and reported there.
                pass
            case tree.Placeholder(kind="*"):
                context.report(UnfinishedCode("the target `*`"), node)
            case tree.Placeholder(kind=kind) if kind.upper() in _DECLARATIONS:
                context.report(UnfinishedDeclaration(f"<{kind.upper()}>"), node)
            case tree.Placeholder(kind=kind):
                context.report(UnfinishedCode(f"<{kind.upper()}>"), node)
            case _:
                pass


def _replacement(context: Context, start: int, end: int, text: str) -> Fix:
    """Return the fix that replaces a part of the text, or inserts into it."""
    edit = Edit(context.module.span(tree.Node(start, end)), text)
    title = f"write `{text.strip()}`" if end > start else f"insert `{text.strip()}`"
    return Fix(title, (edit,))


def _without_parentheses(context: Context, call: tree.Call) -> Fix:
    """Return the fix that takes the arguments of a call out of parentheses."""
    opening = context.module.source.text.index("(", call.name.end)
    first = Edit(
        context.module.span(tree.Node(call.name.end, opening + 1)), " " if call.arguments else ""
    )
    last = Edit(context.module.span(tree.Node(call.end - 1, call.end)), "")
    return Fix("take the parentheses away", (first, last))


def _text(context: Context, node: tree.Node) -> str:
    return context.module.span(node).one_line
