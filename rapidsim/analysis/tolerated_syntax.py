"""Non-RAPID syntax that the parser accepts: one finding for each mark on the tree."""

from __future__ import annotations

from collections.abc import Iterable

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
from rapidsim.analysis.tree_walk import descendants
from rapidsim.syntax import tree

# Placeholders of declarations; the others replace statements, expressions and arguments.
_DECLARATIONS = frozenset({"TDN", "DDN", "RDN", "PAR", "ALT", "DIM"})
_MARKED = frozenset(
    {
        *(tree.Assignment, tree.Data, tree.Call, tree.Branch, tree.While, tree.Case, tree.Unary),
        *(tree.LateFunctionCall, tree.ComponentDeclaration, tree.RecordType, tree.Proc, tree.Func),
        tree.Placeholder,
    }
)
"""The kinds of nodes with marks."""


def check_lenient_marks(items: Iterable[tree.Item], context: Context) -> None:
    """Report every lenient mark and placeholder of some items of a module."""
    text = context.module.source.text
    for node in descendants(*items):
        if type(node) not in _MARKED:
            continue
        match node:
            case tree.Assignment(equals_sign=True):
                written = tree.Node(node.operator_start, node.operator_start + 1)
                context.report(EqualsForAssignment(_text(context, node.target)), written)
            case tree.Data(equals_sign=True):
                context.report(EqualsForAssignment(node.name.text), node)
            case tree.Call(in_parentheses=True):
                context.report(CallInParentheses(node.name.text), node)
            case tree.Branch(then_missing=True):
                context.report(MissingWord("ELSEIF", "THEN"), node.condition)
            case tree.While(do_missing=True):
                context.report(MissingWord("WHILE", "DO"), node.condition)
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
                context.report(MissingParameterList(node.name.text), node.name)
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


def _text(context: Context, node: tree.Node) -> str:
    return context.module.span(node).text
