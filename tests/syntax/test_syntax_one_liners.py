"""One statement, its shape; or its text, and where and why it is wrong."""

from __future__ import annotations

from dataclasses import fields

import pytest

from rapidsim.diagnostics import Diagnostic, Source
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.text_edits import edited_text

HEAD = "MODULE m\nPROC p()\n"
TAIL = "\nENDPROC\nENDMODULE\n"


def body(statement: str) -> tree.Body:
    """The statements of a routine that holds a text."""
    parsed = parse(Source("one", HEAD + statement + TAIL))
    assert not parsed.diagnostics, [d.violation.message for d in parsed.diagnostics]
    return parsed.file.modules[0].routines[0].body


def brief(part: object) -> str:
    """A tree in one line, without places: `Call(P, RequiredArgument(Number(1)))`."""
    match part:
        case tree.Name(text=text) | tree.NumberLiteral(text=text):
            return text
        case tree.DataReference(name=name):
            return name.text
        case tree.StringLiteral(value=value):
            return repr(value)
        case tree.RequiredArgument(value=value, name=None):
            return brief(value)
        case tree.Node():
            values = [getattr(part, f.name) for f in fields(part)[2:] if f.name[-6:] != "_start"]
            shown = ", ".join(brief(v) for v in values if v not in (None, (), False))
            return f"{type(part).__name__}({shown})" if shown else type(part).__name__
        case tuple():
            return f"[{', '.join(map(brief, part))}]"
        case _:
            return str(part)


@pytest.mark.parametrize(
    ("statement", "shape"),
    [
        ("P;", "Call(P)"),
        ("P (a)+(b);", "Call(P, [Binary(Parenthesised(a), +, Parenthesised(b))])"),
        ("P (a);", "Call(P, [Parenthesised(a)])"),
        ("P(a,b);", "Call(P, [a, b], True)"),
        ("P();", "Call(P, True)"),
        ("P(\\A);", "Call(P, [OptionalArgument(A)], True)"),
        ("P -1;", "Call(P, [Unary(-, 1)])"),
        ("P NOT a;", "Call(P, [Unary(NOT, a)])"),
        ("P [1,2];", "Call(P, [LiteralAggregate([1.0, 2.0])])"),
        ("P [1,a];", "Call(P, [Aggregate([1, a])])"),
        ("P [1, ! one\n2];", "Call(P, [LiteralAggregate([1.0, 2.0])])"),
        ("P [- 1];", "Call(P, [LiteralAggregate([-1.0])])"),
        ("P [[[[[[[[1]]]]]]]];", "Call(P, [LiteralAggregate([[[[[[[[1.0]]]]]]]])])"),
        ('P ["a)",TRUE,.5,5.,0x1F];', "Call(P, [LiteralAggregate([a), True, 0.5, 5.0, 31.0])])"),
        ("P \\A;", "Call(P, [OptionalArgument(A)])"),
        ("P \\To:=1;", "Call(P, [OptionalArgument(To, 1)])"),
        ("P a\\B\\C:=d,e;", "Call(P, [a, OptionalArgument(B), OptionalArgument(C, d), e])"),
        ("P a,\\B?c;", "Call(P, [a, ConditionalArgument(B, c)])"),
        ("P Par:=1,2;", "Call(P, [RequiredArgument(1, Par), 2])"),
        ("P *,v1;", "Call(P, [Placeholder(*), v1])"),
        ("WaitTime .5;", "Call(WaitTime, [.5])"),
        ('TPWrite("x");', "Call(TPWrite, [Parenthesised('x')])"),
        ('TPWrite "a!b"; ! c', "Call(TPWrite, ['a!b'])"),
        (r'TPWrite "a""b\\c\41";', "Call(TPWrite, ['a\"b\\\\cA'])"),
        ("x:=1;", "Assignment(x, 1)"),
        ("x=1;", "Assignment(x, 1, True)"),
        (
            "a{1}.x.y{2,3}:=1;",
            "Assignment(Index(ComponentAccess(ComponentAccess(Index(a, [1]), x), y), [2, 3]), 1)",
        ),
        ("x:=a+b*c;", "Assignment(x, Binary(a, +, Binary(b, *, c)))"),
        ("x:=a-b-c;", "Assignment(x, Binary(Binary(a, -, b), -, c))"),
        ("x:=-a*b;", "Assignment(x, Unary(-, Binary(a, *, b)))"),
        ("x:=a*-2;", "Assignment(x, Binary(a, *, Unary(-, 2, True)))"),
        ("x:=a mod b DIV c;", "Assignment(x, Binary(Binary(a, MOD, b), DIV, c))"),
        ("x:=5DIV 2;", "Assignment(x, Binary(5, DIV, 2))"),
        ("x:=NOT a AND b;", "Assignment(x, Unary(NOT, Binary(a, AND, b)))"),
        ("x:=a AND NOT b;", "Assignment(x, Binary(a, AND, Unary(NOT, b, True)))"),
        ("x:=a OR b AND c;", "Assignment(x, Binary(a, OR, Binary(b, AND, c)))"),
        ("x:=a XOR b OR c;", "Assignment(x, Binary(Binary(a, XOR, b), OR, c))"),
        ("x:=a+1>=b;", "Assignment(x, Binary(Binary(a, +, 1), >=, b))"),
        ("x:=f();", "Assignment(x, FunctionCall(f))"),
        ("x:=f(a\\b,c);", "Assignment(x, FunctionCall(f, [a, OptionalArgument(b), c]))"),
        ('x:=%"f"+n%(1);', "Assignment(x, LateFunctionCall(Binary('f', +, n), [1]))"),
        ('%"p"+n% 1,2;', "LateCall(Binary('p', +, n), [1, 2])"),
        ('IF a %"p"%;', "CompactIf(a, LateCall('p'))"),
        ("IF a b:=1;", "CompactIf(a, Assignment(b, 1))"),
        ("IF a b;", "CompactIf(a, Call(b))"),
        ("IF(a)b;", "CompactIf(Parenthesised(a), Call(b))"),
        ("IF a <SMT>", "CompactIf(a, Placeholder(SMT))"),
        ("IF a THEN ENDIF", "If([Branch(a)])"),
        (
            "IF a THEN b; ELSEIF c THEN ELSE d; ENDIF",
            "If([Branch(a, [Call(b)]), Branch(c)], [Call(d)])",
        ),
        ("IF a THEN ELSEIF b c; ENDIF", "If([Branch(a), Branch(b, [Call(c)], True)])"),
        ("FOR i FROM 1TO 3 DO ENDFOR", "For(i, 1, 3)"),
        ("FOR i FROM 3 TO 1 STEP -1 DO P; ENDFOR", "For(i, 3, 1, Unary(-, 1), [Call(P)])"),
        ("WHILE a DO ENDWHILE", "While(a)"),
        ("WHILE a b; ENDWHILE", "While(a, [Call(b)], True)"),
        ("TEST a CASE 1,2: P; DEFAULT: ENDTEST", "Test(a, [Case([1, 2], [Call(P)])])"),
        ("TEST a CASE 1 TO 5: ENDTEST", "Test(a, [Case([1], 5)])"),
        ("x:", "Label(x)"),
        ("GOTO x;", "Goto(x)"),
        ("RETURN;", "Return"),
        ("RETURN a;", "Return(a)"),
        ("RAISE 5;", "Raise(5)"),
        ("EXIT;", "Exit"),
        ("CONNECT i WITH t;", "Connect(i, t)"),
        ('CONNECT i{1} WITH %"t"%;', "Connect(Index(i, [1]), 't')"),
        (";", "Empty"),
        ("<SMT>", "Placeholder(SMT)"),
        ("<VAR>:=<exp>;", "Assignment(Placeholder(VAR), Placeholder(EXP))"),
        ("VAR num x:=1;", "Data(VAR, num, x, 1)"),
        ("VAR num x{2,3};", "Data(VAR, num, x, [2, 3])"),
    ],
)
def test_shape(statement: str, shape: str) -> None:
    assert brief(body(statement)[0]) == shape


def test_a_statement_ends_before_its_semicolon() -> None:
    text = HEAD + "x:=1 ; IF a b ;" + TAIL
    module = parse(Source("one", text)).file.modules[0]
    assert [module.span(s).text for s in module.routines[0].body] == ["x:=1", "IF a b"]


@pytest.mark.parametrize(
    ("statement", "report"),
    [
        ("x:=1\ny:=2;", "3:5 E103 `;` is missing after the assignment to `x`"),
        ("Stop\ny:=2;", "3:5 E103 `;` is missing after the call of `Stop`"),
        ("Stop\nHome;", "3:5 E103 `;` is missing after the call of `Stop`"),
        ("Stop\nMoveL p,v,z,t;", "3:5 E103 `;` is missing after the call of `Stop`"),
        ("x:=1", "3:5 E103 `;` is missing after the assignment to `x`"),
        ("x:=1 y:=2;", "3:5 E103 `;` is missing after the assignment to `x`"),
        ("x:=;", "3:4 E113 an expression is missing in the assignment to `x`"),
        ("MoveL p v,z,t;", "3:8 E113 `,` is missing in the call of `MoveL`"),
        ("MoveL Offs(p,1,2,3,v,z,t;", "3:25 E113 `)` is missing in the call of `MoveL`"),
        ("SetDO d,,1;", "3:9 E114 `,` does not belong in the call of `SetDO`"),
        ("x:=1);", "3:5 E114 `)` does not belong in the assignment to `x`"),
        ("x:=10mm;", "3:6 E114 `mm` does not belong in the assignment to `x`"),
        ("x:=a[2];", "3:5 E120 an element of `a` is written with braces: `a{1}`"),
        ("a[i]:=2;", "3:2 E120 an element of `a` is written with braces: `a{1}`"),
        ("IF a THNE b; ENDIF", "3:6 E112 `THNE` should read THEN"),
        ("IF a THEN\nb;\nEDNIF\nc:=1;", "5:1 E112 `EDNIF` should read ENDIF"),
        ("IF a THEN\nb;\nEND IF", "5:1 E112 `END IF` should read ENDIF"),
        (
            "IF a:=1 b;",
            "3:5 E114 `:=`, which assigns where `=` compares, does not belong in the IF statement",
        ),
        (
            "IF a=b=c THEN d; ENDIF",
            "3:7 E117 the IF statement cannot be read: `=` where a name is expected",
        ),
        (
            "FOR i=1 TO 3 DO ENDFOR",
            "3:6 E114 `=`, read as FROM, does not belong in the head of the FOR loop",
        ),
        ("ENDIF", "3:1 E115 ENDIF without IF"),
        ("ELSE", "3:1 E115 ELSE without IF"),
        ("CASE 1:", "3:1 E115 CASE without TEST"),
        ("TEST a\nCASE 1\nENDTEST", "4:7 E113 `:` is missing in the TEST statement"),
        ('TPWrite "a;', '3:9 E109 the closing `"` of the string is missing'),
        (
            'TPWrite "a\\x";',
            "3:11 E116 a `\\` in a string must be doubled or followed by two hexadecimal digits",
        ),
        ("VAR num to;", "3:9 E121 `to` is a reserved word and cannot be a name"),
        (
            "VAR num a(b):=1;",
            "3:9 E122 `a(b)` is not a valid name: use letters, digits and `_` only",
        ),
        ("x:=1; #", "3:7 E118 `#` has no meaning in RAPID"),
        ("x:=1E999;", "3:4 E108 the number is larger than a dnum; the limit is 1.8E308"),
        (f"{'a' * 33};", f"3:1 E108 the name `{'a' * 33}` has 33 characters; the limit is 32"),
        (f'TPWrite "{"a" * 81}";', "3:9 E108 the string has 81 characters; the limit is 80"),
        ("ERROR\nERROR\nRETRY;", "4:1 E119 the routine has an ERROR clause already"),
    ],
)
def test_report(statement: str, report: str) -> None:
    diagnostics = parse(Source("one", HEAD + statement + TAIL)).diagnostics
    assert [reported(d) for d in diagnostics] == [report]
    assert {d.routine for d in diagnostics} == {"p"}


def reported(diagnostic: Diagnostic) -> str:
    span = diagnostic.span
    assert span is not None
    violation = diagnostic.violation
    return f"{span.line}:{span.column} {violation.code} {violation.message}"


@pytest.mark.parametrize(
    ("statement", "repaired"),
    [
        ("IF a=>1 b;", "IF a>=1 b;"),
        ("IF a:=1 b;", "IF a=1 b;"),
        ("IF a==1 b;", "IF a=1 b;"),
        ("IF a && b c;", "IF a AND b c;"),
        ("IF a||b c;", "IF a OR b c;"),
        ("x==1;", "x:=1;"),
        ("x+=2*y;", "x:=x+2*y;"),
        ("a{1}.b -= 1;", "a{1}.b :=a{1}.b- 1;"),
        ("IF (a>1 b;", "IF (a>1) b;"),
        ("AccSet 50 50;", "AccSet 50, 50;"),
        ("p 1,,2;", "p 1,2;"),
        ("FOR i=1 TO 3 DO ENDFOR", "FOR i FROM 1 TO 3 DO ENDFOR"),
        ("FOR i FROM 1 TO 3\n  x:=i;\nENDFOR", "FOR i FROM 1 TO 3 DO\n  x:=i;\nENDFOR"),
        ("WHILE a DO\n  b; ! always\n", "WHILE a DO\n  b; ! always\nENDWHILE\n"),
        ("IF a\n  b;\nELSE\n  c;\nENDIF", "IF a THEN\n  b;\nELSE\n  c;\nENDIF"),
        ("IF a THEN\n  b;\nELSE:\n  c;\nENDIF", "IF a THEN\n  b;\nELSE\n  c;\nENDIF"),
        ("IF a THEN\n  b;\nEND", "IF a THEN\n  b;\nENDIF"),
        ('TPWrite "a;', 'TPWrite "a";'),
    ],
)
def test_fix(statement: str, repaired: str) -> None:
    """A fix writes what the parser assumed; the text can be read then."""
    text = HEAD + statement + TAIL
    diagnostics = parse(Source("one", text)).diagnostics
    fixes = [d.fix for d in diagnostics if d.fix]
    assert len(fixes) == len(diagnostics) == 1
    edits = [(edit.span.start, edit.span.end, edit.text) for edit in fixes[0].edits]
    assert edited_text(text, edits) == HEAD + repaired + TAIL
    assert not parse(Source("one", HEAD + repaired + TAIL)).diagnostics
