"""Conversion of a tree to text: RAPID in one canonical layout.

The printed text parses to the same tree. Comments and blank lines are not part of the tree and
therefore not printed; lenient marks are printed as written.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import assert_never

from rapidsim.syntax import tree
from rapidsim.syntax.tree import LiteralValue

_INDENT = "  "
_WRITTEN_OUT = 1e7
"""Limit beyond which integers are printed with an exponent."""


def print_module(module: tree.Module) -> str:
    """Format a module as text, with a final line end."""
    attributes = f"({','.join(attribute.text for attribute in module.attributes)})"
    head = f"MODULE {module.name.text}{attributes if module.attributes else ''}"
    lines = [line for item in module.items for line in _item(item, module)]
    return "\n".join([head, *_indented(lines), "ENDMODULE", ""])


def print_data(data: tree.Data) -> str:
    """Format a declaration of data as text."""
    return _data(data)


def print_routine(routine: tree.Routine, module: tree.Module) -> list[str]:
    """Format a routine as lines; its statements are indented by two blanks."""
    return list(_routine(routine, module))


def print_statement(statement: tree.Statement, module: tree.Module) -> list[str]:
    """Format a statement as lines; nested ones are indented by two blanks."""
    return list(_statement(statement, module))


def print_expression(expression: tree.Expression) -> str:
    """Format an expression as text."""
    match expression:
        case tree.NumberLiteral(text=text):
            return text
        case tree.StringLiteral(value=value):
            return _string(value)
        case tree.BoolLiteral(value=value):
            return "TRUE" if value else "FALSE"
        case tree.DataReference(name=name):
            return name.text
        case tree.Index(array=array, indices=indices):
            return f"{print_expression(array)}{{{_list(indices)}}}"
        case tree.ComponentAccess(record=record, name=name):
            return f"{print_expression(record)}.{name.text}"
        case tree.FunctionCall(name=name, arguments=arguments):
            return f"{name.text}({_arguments(arguments)})"
        case tree.LateFunctionCall(routine=routine, arguments=arguments):
            return f"%{print_expression(routine)}%({_arguments(arguments)})"
        case tree.Aggregate(elements=elements):
            return f"[{_list(elements)}]"
        case tree.LiteralAggregate(value=value):
            return _literal(value)
        case tree.Unary(operator=operator, operand=operand):
            blank = " " if operator.isalpha() else ""
            return f"{operator}{blank}{print_expression(operand)}"
        case tree.Binary(left=left, operator=operator, right=right):
            blank = " " if operator.isalpha() else ""
            text = f"{print_expression(left)}{blank}{operator}{blank}"
            return text + print_expression(right)
        case tree.Parenthesised(inner=inner):
            return f"({print_expression(inner)})"
        case tree.Placeholder(kind=kind):
            return _placeholder(kind)
        case _:
            assert_never(expression)


def _item(item: tree.Item, module: tree.Module) -> Iterator[str]:
    match item:
        case tree.RecordType(scope=scope, name=name, components=components):
            yield f"{_scope(scope)}RECORD {name.text}"
            for component in components:
                if isinstance(component, tree.Placeholder):
                    yield _INDENT + _placeholder(component.kind)
                else:
                    sizes = _dimensions(component.dimensions)
                    yield f"{_INDENT}{component.type.text} {component.name.text}{sizes};"
            yield "ENDRECORD"
        case tree.AliasType(scope=scope, type=of, name=name):
            yield f"{_scope(scope)}ALIAS {of.text} {name.text};"
        case tree.Data():
            yield _data(item)
        case tree.Proc() | tree.Func() | tree.Trap():
            yield from _routine(item, module)
        case tree.InvalidStatement():
            yield module.span(item).text
        case tree.Placeholder(kind=kind):
            yield _placeholder(kind)
        case _:
            assert_never(item)


def _data(data: tree.Data) -> str:
    sizes = _dimensions(data.dimensions)
    text = f"{_scope(data.scope)}{data.storage} {data.type.text} {data.name.text}{sizes}"
    if data.value is not None:
        text += ("=" if data.equals_sign else ":=") + print_expression(data.value)
    return text + ";"


def _routine(routine: tree.Routine, module: tree.Module) -> Iterator[str]:
    parameters = "" if routine.parentheses_missing else f"({_parameters(routine.parameters)})"
    scope, name = _scope(routine.scope), routine.name.text
    match routine:
        case tree.Proc():
            head, word = f"{scope}PROC {name}{parameters}", "PROC"
        case tree.Func(type=of):
            head, word = f"{scope}FUNC {of.text} {name}{parameters}", "FUNC"
        case tree.Trap():
            head, word = f"{scope}TRAP {name}", "TRAP"
        case _:
            assert_never(routine)
    yield head
    yield from _body(routine.body, module)
    if routine.backward is not None:
        yield "BACKWARD"
        yield from _body(routine.backward, module)
    if routine.error is not None:
        numbers = routine.error.numbers
        yield "ERROR" if numbers is None else f"ERROR ({_list(numbers)})"
        yield from _body(routine.error.body, module)
    if routine.undo is not None:
        yield "UNDO"
        yield from _body(routine.undo, module)
    yield f"END{word}"


def _parameters(
    parameters: Sequence[tree.ParameterDeclaration | tree.OptionalGroup | tree.Placeholder],
) -> str:
    return ",".join(_parameter(parameter) for parameter in parameters)


def _parameter(parameter: tree.ParameterDeclaration | tree.OptionalGroup | tree.Placeholder) -> str:
    match parameter:
        case tree.Placeholder(kind=kind):
            return _placeholder(kind)
        case tree.OptionalGroup(alternatives=alternatives):
            return "\\" + "|".join(_parameter(alternative) for alternative in alternatives)
        case tree.ParameterDeclaration(mode=mode, type=of, name=name, dimensions=dimensions):
            stars = f"{{{','.join('*' * dimensions)}}}" if dimensions else ""
            return f"{'' if mode == 'IN' else mode + ' '}{of.text} {name.text}{stars}"
        case _:
            assert_never(parameter)


def _body(body: tree.Body, module: tree.Module) -> Iterator[str]:
    return _indented(line for statement in body for line in _statement(statement, module))


def _statement(statement: tree.Statement, module: tree.Module) -> Iterator[str]:
    match statement:
        case tree.If(branches=branches, otherwise=otherwise):
            for word, branch in zip(_if_words(branches), branches, strict=True):
                if word == "<EIT>":
                    yield word
                    continue
                then = "" if branch.then_missing else " THEN"
                yield f"{word} {print_expression(branch.condition)}{then}"
                yield from _body(branch.body, module)
            if otherwise is not None:
                yield "ELSE"
                yield from _body(otherwise, module)
            yield "ENDIF"
        case tree.For(counter=counter, first=first, last=last, step=step, body=body):
            by = "" if step is None else f" STEP {print_expression(step)}"
            limits = f"FROM {print_expression(first)} TO {print_expression(last)}{by}"
            yield f"FOR {counter.text} {limits} DO"
            yield from _body(body, module)
            yield "ENDFOR"
        case tree.While(condition=condition, body=body, do_missing=do_missing):
            yield f"WHILE {print_expression(condition)}{'' if do_missing else ' DO'}"
            yield from _body(body, module)
            yield "ENDWHILE"
        case tree.Test(subject=subject, cases=cases, default=default):
            yield f"TEST {print_expression(subject)}"
            for case in cases:
                yield _case_head(case)
                yield from _body(case.body, module)
            if default is not None:
                yield "DEFAULT:"
                yield from _body(default, module)
            yield "ENDTEST"
        case tree.Label(name=name):
            yield f"{name.text}:"
        case tree.Data():
            yield _data(statement)
        case tree.Empty():
            yield ";"
        case tree.InvalidStatement():
            yield module.span(statement).text
        case tree.Placeholder(kind=kind):
            yield _placeholder(kind)
        case tree.CompactIf(condition=condition, statement=tree.Placeholder(kind=kind)):
            yield f"IF {print_expression(condition)} {_placeholder(kind)}"
        case _:
            yield _simple(statement) + ";"


def _if_words(branches: Sequence[tree.Branch]) -> Iterator[str]:
    for number, branch in enumerate(branches):
        if number == 0:
            yield "IF"
        elif isinstance(branch.condition, tree.Placeholder) and branch.condition.kind == "EIT":
            yield "<EIT>"
        else:
            yield "ELSEIF"


def _case_head(case: tree.Case) -> str:
    first = case.values[0]
    if isinstance(first, tree.Placeholder) and first.kind == "CSE":
        return "<CSE>"
    if case.range_to is not None:
        return f"CASE {print_expression(first)} TO {print_expression(case.range_to)}:"
    return f"CASE {_list(case.values)}:"


def _simple(statement: tree.Statement) -> str:
    """Format a statement that fits on one line, without its semicolon."""
    match statement:
        case tree.Assignment(target=target, value=value, equals_sign=equals_sign):
            becomes = "=" if equals_sign else ":="
            return f"{_target(target)}{becomes}{print_expression(value)}"
        case tree.Call(name=name, arguments=arguments, in_parentheses=in_parentheses):
            listed = _arguments(arguments)
            return f"{name.text}({listed})" if in_parentheses else f"{name.text} {listed}".rstrip()
        case tree.LateCall(routine=routine, arguments=arguments):
            return f"%{print_expression(routine)}% {_arguments(arguments)}".rstrip()
        case tree.CompactIf(condition=condition, statement=body):
            return f"IF {print_expression(condition)} {_simple(body)}"
        case tree.Goto(name=name):
            return f"GOTO {name.text}"
        case tree.Return(value=value):
            return "RETURN" if value is None else f"RETURN {print_expression(value)}"
        case tree.Raise(number=number):
            return "RAISE" if number is None else f"RAISE {print_expression(number)}"
        case tree.Exit():
            return "EXIT"
        case tree.Retry():
            return "RETRY"
        case tree.TryNext():
            return "TRYNEXT"
        case tree.Connect(interrupt=interrupt, trap=trap):
            with_trap = trap.text if isinstance(trap, tree.Name) else f"%{print_expression(trap)}%"
            return f"CONNECT {_target(interrupt)} WITH {with_trap}"
        case _:
            raise AssertionError(f"{type(statement).__name__} is not a statement of one line")


def _target(target: tree.DataPath | tree.Placeholder) -> str:
    if isinstance(target, tree.Placeholder):
        return "<VAR>"
    return print_expression(target)


def _arguments(arguments: Iterable[tree.Argument]) -> str:
    text = ""
    for argument in arguments:
        match argument:
            case tree.RequiredArgument(value=value, name=name):
                named = "" if name is None else f"{name.text}:="
                text += f",{named}{print_expression(value)}"
            case tree.OptionalArgument(name=name, value=option):
                given = "" if option is None else f":={print_expression(option)}"
                text += f"\\{name.text}{given}"
            case tree.ConditionalArgument(name=name, present=present):
                text += f"\\{name.text}?{present.text}"
            case _:
                assert_never(argument)
    return text.removeprefix(",")


def _list(expressions: Iterable[tree.Expression]) -> str:
    return ",".join(print_expression(expression) for expression in expressions)


def _dimensions(dimensions: Sequence[tree.Expression]) -> str:
    return f"{{{_list(dimensions)}}}" if dimensions else ""


def _scope(scope: str | None) -> str:
    return f"{scope} " if scope else ""


def _placeholder(kind: str) -> str:
    return "*" if kind == "*" else f"<{kind}>"


def _literal(value: LiteralValue) -> str:
    if isinstance(value, tuple):
        return f"[{','.join(_literal(element) for element in value)}]"
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    if isinstance(value, str):
        return _string(value)
    if math.isinf(value):
        return "9E999" if value > 0 else "-9E999"  # larger than a dnum, which has been reported
    return f"{value:.0f}" if value.is_integer() and abs(value) < _WRITTEN_OUT else repr(value)


def _string(value: str) -> str:
    """Format a string as RAPID source: control characters are written as their codes."""
    escaped = value.replace("\\", "\\\\").replace('"', '""')
    return (
        '"' + "".join(c if c >= " " and c != "\x7f" else f"\\{ord(c):02X}" for c in escaped) + '"'
    )


def _indented(lines: Iterable[str]) -> Iterator[str]:
    return (_INDENT + line for line in lines)
