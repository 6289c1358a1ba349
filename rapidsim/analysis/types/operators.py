"""The result types of operators.

Source: Technical reference manual RAPID Kernel, "Expressions"; RAPID Overview, "Expressions".
"""

from __future__ import annotations

from types import MappingProxyType

from rapidsim.analysis.evaluation import ARITHMETIC
from rapidsim.analysis.tree_walk import descendants
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Atomic, Kind, Record, Type, resolved
from rapidsim.library.predefined import TYPES
from rapidsim.syntax import tree

_POS, _ORIENT = TYPES["pos"], TYPES["orient"]
_RESULTS = MappingProxyType(
    {
        ("+", "num", "num"): types.NUM,
        ("+", "dnum", "dnum"): types.DNUM,
        ("+", "pos", "pos"): _POS,
        ("+", "string", "string"): types.STRING,
        ("-", "num", "num"): types.NUM,
        ("-", "dnum", "dnum"): types.DNUM,
        ("-", "pos", "pos"): _POS,
        ("*", "num", "num"): types.NUM,
        ("*", "dnum", "dnum"): types.DNUM,
        ("*", "num", "pos"): _POS,
        ("*", "pos", "num"): _POS,
        ("*", "pos", "pos"): _POS,
        ("*", "orient", "orient"): _ORIENT,
        ("/", "num", "num"): types.NUM,
        ("/", "dnum", "dnum"): types.DNUM,
        ("/", "pos", "num"): _POS,
        ("DIV", "num", "num"): types.NUM,
        ("DIV", "dnum", "dnum"): types.DNUM,
        ("MOD", "num", "num"): types.NUM,
        ("MOD", "dnum", "dnum"): types.DNUM,
    }
)
ORDERING = frozenset({"<", "<=", ">", ">="})
EQUALITY = frozenset({"=", "<>"})
LOGICAL = frozenset({"AND", "OR", "XOR"})


def binary_result(operator: str, left: Type, right: Type) -> Type | None:
    """The type of `left operator right`; None if the operator does not accept these operands."""
    a, b = value_type(left), value_type(right)
    if operator in LOGICAL:
        return types.BOOL if a == b == types.BOOL else None
    if operator in ORDERING:
        return types.BOOL if a == b and a in (types.NUM, types.DNUM) else None
    if operator in EQUALITY:
        return types.BOOL if _comparable(a, b) and has_value(a) else None
    return _RESULTS.get((operator, a.name.lower(), b.name.lower()))


def _comparable(a: Type, b: Type) -> bool:
    """Whether two types are equal, or arrays that may have the same sizes."""
    if not isinstance(a, ArrayOf) or not isinstance(b, ArrayOf):
        return a == b
    sizes = zip(a.dimensions, b.dimensions, strict=False)
    return (
        resolved(a.element) == resolved(b.element)
        and len(a.dimensions) == len(b.dimensions)
        and all(m == n or None in (m, n) for m, n in sizes)
    )


def unary_result(operator: str, operand: Type) -> Type | None:
    """The type of `operator operand`; None if the operator does not accept it."""
    of = value_type(operand)
    if operator == "NOT":
        return types.BOOL if of == types.BOOL else None
    return of if of in (types.NUM, types.DNUM, _POS) else None


def value_type(of: Type) -> Atomic | Record | ArrayOf:
    """The type of the value when read: aliases resolved, a signal as its number."""
    target = resolved(of)
    if isinstance(target, Atomic) and target.reads_as is not None:
        return resolved(TYPES[target.reads_as])
    return target


def has_value(of: Type) -> bool:
    """Whether data of a type can be read, assigned and compared."""
    match resolved(of):
        case Atomic(kind=kind):
            return kind is not Kind.NON_VALUE
        case Record(components=components):
            return all(has_value(component.type) for component in components)
        case ArrayOf(element=element):
            # An array of signals cannot be read as a whole.
            return has_value(element) and value_type(element) == resolved(element)


def likely_fix(operator: str, left: Type, right: Type) -> str:
    """Suggest a fix for an invalid combination; empty if unclear."""
    names = {value_type(left).name.lower(), value_type(right).name.lower()}
    if names == {"num", "dnum"}:
        return "convert one of them with NumToDnum(...) or DnumToNum(...)"
    if "string" in names and operator == "+":
        return "turn the other operand into a string with NumToStr(...) or ValToStr(...)"
    if names == {"string"} and operator in ORDERING:
        return "compare strings with StrOrder(...)"
    if names == {"pos", "robtarget"} or names == {"robtarget", "num"}:
        return "displace a robtarget with Offs(...), or add to its `.trans`"
    if names == {"robtarget"} or names == {"pose"}:
        return "compute with `.trans` and `.rot`, or with PoseMult(...)"
    if "num" in names and (operator in LOGICAL or "bool" in names):
        return "compare the number first, as in `x=1`"
    return ""


def is_literal_number(node: tree.Expression) -> bool:
    """Whether an expression consists of literal numbers and operators only."""
    return all(
        isinstance(part, tree.NumberLiteral | tree.Unary | tree.Parenthesised)
        or (isinstance(part, tree.Binary) and part.operator in ARITHMETIC)
        for part in descendants(node)
    )
