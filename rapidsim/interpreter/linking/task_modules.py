"""Modules that a running task loads and unloads: implements `language.modules.Modules`.

Every change builds a program of all modules and checks it as a whole, so a `Program` never has
errors. A module that uses undeclared names is loaded, as on the controller, but stays outside the
program until another module declares them.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "Load", "UnLoad",
"StartLoad", "WaitLoad", "EraseModule", "CheckProgRef", "Save".
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache, partial

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.names.name_violations import (
    ComponentOfUnknownType,
    UndefinedName,
    UnknownRoutine,
    UnknownType,
)
from rapidsim.analysis.passes.checker import CheckOutcome, check
from rapidsim.diagnostics import Diagnostic, Severity, Source
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.linking.linker import LinkedProgram
from rapidsim.interpreter.linking.saved_text import saved_text, text_of
from rapidsim.language.error_numbers import (
    ERR_LINKREF,
    ERR_LOADED,
    ERR_MODULE,
    ERR_PRGMEMFULL,
    ERR_SYNTAX,
    ERR_UNLOAD,
    rapid_error,
)
from rapidsim.language.modules import SavedModule
from rapidsim.syntax import tree
from rapidsim.syntax.parser import Parsed, parse
from rapidsim.values import value_class

PROGRAM_MEMORY = 50_000_000
"""Maximum number of characters of the modules that a task has loaded at one time."""
MOST_KNOWN = 16
"""Maximum number of cached files, and of cached combinations of modules."""


@value_class(frozen=True, slots=True, eq=False)
class _Entry:
    """A module in the program memory."""

    module: tree.Module
    path: str | None = None
    """The file it was loaded from; None if it is an initial module of the task."""

    @property
    def name(self) -> str:
        return self.module.name.text


class TaskModules:
    """The program memory of one task."""

    def __init__(self, linked: LinkedProgram) -> None:
        """Begin with the modules of a linked program."""
        self._linked = linked
        # A cell loads the same few files repeatedly.
        self._parse = lru_cache(maxsize=MOST_KNOWN)(_parsed)
        self._check = lru_cache(maxsize=MOST_KNOWN)(partial(_checked, cell=linked.program.cell))
        self._entries = [_Entry(module) for module in linked.program.modules]

    def has(self, name: str) -> bool:
        """Whether there is a module of that name, in any case."""
        is_loaded = any(entry.module.name.key == name.lower() for entry in self._entries)
        return is_loaded or self.is_unread(name)

    def is_unread(self, name: str) -> bool:
        """Whether there is a module of that name, in any case, that cannot be read here."""
        return self._linked.program.cell.is_unread(name)

    def load(self, source: Source, path: str, *, check_references: bool) -> None:
        """Load the modules of a file; raises the errors of `Modules.load`."""
        parsed = self._parse(source.file, source.text)
        errors = [one for one in parsed.diagnostics if one.severity is Severity.ERROR]
        if errors:
            raise rapid_error(ERR_SYNTAX, _summary(errors))
        if not parsed.file.modules:
            raise rapid_error(ERR_SYNTAX, f"{path} holds no module")
        for module in parsed.file.modules:
            self._refuse_second(module, path)
        held = sum(len(one.module.source.text) for one in self._entries if one.path is not None)
        if held + len(source.text) > PROGRAM_MEMORY:
            raise rapid_error(
                ERR_PRGMEMFULL,
                f"{path}: a task may load {PROGRAM_MEMORY:g} characters of program; unload some",
            )
        new = [_Entry(module, path) for module in parsed.file.modules]
        try:
            self._become([*self._entries, *new], ERR_LINKREF, check_references=check_references)
        except NotExecutableError as error:
            raise rapid_error(ERR_LINKREF, str(error)) from None

    def unload(self, path: str) -> None:
        """Unload the modules that were loaded from a file."""
        gone = [entry for entry in self._entries if _same_file(entry.path, path)]
        if not gone:
            raise rapid_error(ERR_UNLOAD, f"no module was loaded from {path} with Load")
        self._remove(gone, ERR_UNLOAD)

    def erase(self, name: str) -> None:
        """Remove a module by name."""
        self._remove([self._entry(name)], ERR_MODULE)

    def check_references(self) -> None:
        """Raise ERR_LINKREF if an undeclared name is used."""
        checked, waiting = self._check(tuple(entry.module for entry in self._entries))
        _require_references(checked, waiting, self._entries)

    def loaded_from(self, path: str) -> tuple[SavedModule, ...]:
        """The modules that were loaded from a file."""
        return tuple(self._saved(one) for one in self._entries if _same_file(one.path, path))

    def saved(self, name: str) -> SavedModule:
        """The text of a module, by name."""
        return self._saved(self._entry(name))

    def _refuse_second(self, module: tree.Module, path: str) -> None:
        for entry in self._entries:
            if entry.module.name.key == module.name.key:
                loaded = f"was loaded from {entry.path}; UnLoad it first"
                given = "began with it; keep what is loaded later in the home folder only"
                raise rapid_error(
                    ERR_LOADED,
                    f"{path}: there is a module {entry.name} already: "
                    + (f"it {loaded}" if entry.path is not None else f"the task {given}"),
                )

    def _entry(self, name: str) -> _Entry:
        for entry in self._entries:
            if entry.module.name.key == name.strip().lower():
                return entry
        raise rapid_error(ERR_MODULE, f"the task has no module {name}")

    def _saved(self, entry: _Entry) -> SavedModule:
        text = saved_text(entry.module, self._linked)
        return SavedModule(entry.name, text, text_of(entry.module), entry.path)

    def _remove(self, removed: Sequence[_Entry], errno: float) -> None:
        executing = self._linked.executing()
        for entry in removed:
            if entry.module in executing:
                raise rapid_error(errno, f"module {entry.name} executes and cannot be removed")
        self._become([entry for entry in self._entries if entry not in removed], errno)

    def _become(
        self, entries: list[_Entry], errno: float, *, check_references: bool = False
    ) -> None:
        """Replace the modules in the program memory; an exception leaves it unchanged.

        Args:
            entries: All modules.
            errno: Error number for modules that are incompatible.
            check_references: Reject modules that use undeclared names.
        """
        checked, waiting = self._check(tuple(entry.module for entry in entries))
        executing = self._linked.executing()
        for entry in entries:
            finding = waiting.get(entry.module)
            if finding is not None and (entry.path is None or entry.module in executing):
                raise rapid_error(
                    errno, f"without it, {_summary([finding])} in module {entry.name}"
                )
        if checked.program is None:
            raise rapid_error(errno, _summary(_errors(checked)))
        if check_references:
            _require_references(checked, waiting, entries)
        self._linked.link(checked.program)
        self._entries = entries
        self._linked.late.waiting = {
            routine.name.key: f"module {module.name.text} waits: {_summary([finding])}"
            for module, finding in waiting.items()
            for routine in module.routines
        }


_UNDECLARED = (UndefinedName, UnknownRoutine, UnknownType)


def _parsed(file: str, text: str) -> Parsed:
    """Parse a file; cached by text, because each read creates a new `Source`."""
    return parse(Source(file, text))


def _checked(
    modules: tuple[tree.Module, ...], cell: CellNames
) -> tuple[CheckOutcome, Mapping[tree.Module, Diagnostic]]:
    """Check modules together.

    Returns:
        The outcome without the modules that use undeclared names; and those modules, each with its
        first undeclared name.
    """
    linked = list(modules)
    waiting: dict[tree.Module, Diagnostic] = {}
    while True:
        checked = check([tree.File(one.source, (one,), ()) for one in linked], cell=cell)
        found = _undeclared(checked)
        blocked = {
            one: finding for finding in reversed(found) for one in linked if _holds(one, finding)
        }
        if checked.program is not None or not blocked:
            return checked, waiting
        waiting |= blocked
        linked = [one for one in linked if one not in blocked]


def _undeclared(checked: CheckOutcome) -> list[Diagnostic]:
    """Undeclared names that another module could declare; empty if there is any other error."""
    errors = _errors(checked)
    if not errors:
        return [
            one for one in checked.diagnostics if isinstance(one.violation, ComponentOfUnknownType)
        ]
    return errors if all(isinstance(one.violation, _UNDECLARED) for one in errors) else []


def _errors(checked: CheckOutcome) -> list[Diagnostic]:
    return [one for one in checked.diagnostics if one.severity is Severity.ERROR]


def _require_references(
    checked: CheckOutcome, waiting: Mapping[tree.Module, Diagnostic], entries: Iterable[_Entry]
) -> None:
    """Raise if a loaded module of a program uses undeclared names.

    Undeclared names in the initial modules are assumed to come from add-ins: a controller would not
    have started the task without them.
    """
    loaded = [entry for entry in entries if entry.path is not None]
    missing = [
        *waiting.values(),
        *(
            one
            for one in checked.diagnostics
            if isinstance(one.violation, UnknownRoutine)
            and any(_holds(entry.module, one) for entry in loaded)
        ),
    ]
    if missing:
        raise rapid_error(ERR_LINKREF, _summary(missing))


def _holds(module: tree.Module, finding: Diagnostic) -> bool:
    """Whether a finding is located in a module."""
    span = finding.span
    if span is None or span.source is not module.source:
        return False
    return module.start <= span.start <= module.end


def _summary(findings: Sequence[Diagnostic]) -> str:
    """Message of the first finding with its position, and the number of the others."""
    first = findings[0]
    place = f"{first.span.file}:{first.span.line}: " if first.span else ""
    more = f" (and {len(findings) - 1} more)" if len(findings) > 1 else ""
    return f"{place}{first.violation.message}{more}"


def _same_file(path: str | None, other: str) -> bool:
    return path is not None and _folded(path) == _folded(other)


def _folded(path: str) -> str:
    r"""Canonical form of a path of the home folder: the same for HOME:/a, /a and a."""
    _, _, rest = path.replace("\\", "/").lower().rpartition("home:")
    return "/".join(part for part in rest.split("/") if part not in ("", "."))
