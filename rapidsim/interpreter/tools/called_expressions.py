"""Value of an expression that calls functions, at the position of a frame.

The expression becomes a function of a module of its own, in which the variables of the routine have
the values that they have in the frame. Calling it may change data and let time pass: a debugger
does so in a copy of the process.
"""

from __future__ import annotations

from types import FrameType

from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program import RoutineSymbol
from rapidsim.diagnostics import Severity, Source
from rapidsim.interpreter.codegen.names import free_name
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.linking.linker import LinkedProgram
from rapidsim.interpreter.linking.loader import FatalError, Task
from rapidsim.interpreter.linking.symbols import TaskSymbols
from rapidsim.interpreter.tools.expression_queries import own_names
from rapidsim.interpreter.tools.inspection import NotShownError, data_of, local_names
from rapidsim.language.errors import Stopped
from rapidsim.language.symbols import DataName
from rapidsim.language.types import Type
from rapidsim.library.text import value_text
from rapidsim.syntax import tree
from rapidsim.syntax.lexer import lex
from rapidsim.syntax.parser import parse


def called_value(text: str, of: Type, frame: FrameType, linked: LinkedProgram) -> str:
    """Evaluate an expression by executing it.

    Args:
        text: The expression, which is correct at the position of the frame.
        of: Its type.
        frame: Frame of a routine of the program.
        linked: The program of the frame's task.

    Raises:
        NotShownError: If it fails, with the reason.
    """
    program = linked.program
    words = {word.lower() for word in lex(text).words}
    held = {}
    for name in local_names(frame):
        if name.lower() in words:
            held[name] = data_of(name, frame)
    module = free_name("rapidsim_looks", set(own_names(program)))
    lines = [f"LOCAL VAR {_declared(name, of)};" for name, (_, of) in held.items()]
    function = free_name("rapidsim_value", set(own_names(program)))
    source = "\n".join(
        [
            *(f"MODULE {module}", *lines, f"LOCAL FUNC {of.name} {function}()", "RETURN"),
            *(text, ";", "ENDFUNC", "ENDMODULE", ""),
        ]
    )
    parsed = parse(Source("", source))
    files = [tree.File(one.source, (one,), ()) for one in program.modules]
    checked = check(files, cell=program.cell, visitor=parsed.file)
    if checked.program is None:
        errors = (one for one in checked.diagnostics if one.severity is Severity.ERROR)
        first = next(errors, None)
        reason = "it cannot be called here" if first is None else first.violation.message
        raise NotShownError(reason)
    task, own = Task(linked), parsed.file.modules[0]
    try:
        task.take(checked.program)
        symbols = TaskSymbols(linked)
        for name, (value, kind) in held.items():
            symbols.write(name, kind, DataName(name, own.name.text), value)
        symbol = checked.program.symbol_of[own.routines[0]]
        assert isinstance(symbol, RoutineSymbol)
        return value_text(task.call(symbol), of)
    except FatalError as error:
        raise NotShownError(str(error.error)) from None
    except (NotExecutableError, Stopped) as error:
        raise NotShownError(str(error)) from None


def _declared(name: str, of: Type) -> str:
    """Declaration of a variable: `num n`, `pos a{3}`."""
    type_name, brace, sizes = of.name.partition("{")
    return f"{type_name} {name}{brace}{sizes}"
