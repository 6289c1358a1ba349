"""Rules N2: names that are undeclared, ambiguous, or of the wrong kind."""

from __future__ import annotations

from rapidsim.diagnostics import Severity, Violation


class UndefinedName(Violation, code="N201"):
    undefined: str
    nearest: str | None = None
    reserved: bool = False
    """Whether the nearest name is a reserved word."""
    loads_modules: bool = False
    """Whether the task adds other modules while it runs."""
    may_be_signal: bool = False
    """Whether the name occurs at a place where a signal's value may be used."""
    kind: str = "data"
    """`data` or `trap`."""
    assumed: str | None = None
    """Predefined data that could be assumed for the name."""

    @property
    def case(self) -> str:
        """Case of the rule by the kind of the missing name."""
        return self.kind

    @property
    def help(self) -> str:
        """Suggestion of the nearest name, or of a declaration."""
        if self.nearest and self.reserved:
            return f"did you mean the word {self.nearest}?"
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        if self.loads_modules:
            return "read data of a module that is loaded while the program runs with GetDataVal"
        declare = "declare it, or check the module that declares it together with this one"
        if self.assumed:
            return f"{declare}; `--assume-missing` takes {self.assumed}"
        if self.may_be_signal:
            return f"{declare}; if it is a signal, declare it in [signals] of rapidsim.toml"
        return declare


class UnseenName(Violation, code="N216"):
    undefined: str
    modules: tuple[str, ...]
    nearest: str | None = None
    kind: str = "data"
    """`data`, at which a run ends; `procedure`, `function` or `data type`, which are skipped."""

    @property
    def case(self) -> str:
        """Case of the rule by the kind of the missing name."""
        return self.kind

    @property
    def help(self) -> str:
        """Modules that may declare the name, or the nearest name."""
        where = f"it may be declared in {' or '.join(self.modules)}, which cannot be read here"
        if self.kind != "data":
            where += "; a run continues without it"
        return f"{where}; or did you mean `{self.nearest}`?" if self.nearest else where


class UnresolvedReference(Violation, code="N221"):
    undefined: str


class DuplicateName(Violation, code="N202"):
    duplicate: str
    location: str = ""
    between_modules: bool = False
    kind: str = ""
    """Kind of the duplicate, in the terms of rule.toml."""
    of_own_module: bool = False
    """Whether a routine has the name of its module."""

    @property
    def severity(self) -> Severity:
        """Error; a warning for the name of the module, which programs in use have."""
        return Severity.WARNING if self.of_own_module else Severity.ERROR

    @property
    def case(self) -> str:
        """Case of the rule by the kind of the duplicate."""
        return self.kind

    @property
    def help(self) -> str:
        """Suggestion that makes the names distinct."""
        if self.kind == "module":
            return (
                "files named together form one task: remove the copy, or check "
                "each program separately"
            )
        if self.between_modules and self.duplicate.lower() == "main":
            return (
                "files named together form one task: name each program separately, or let "
                "`rapidsim init` give each a [[task]] in rapidsim.toml"
            )
        if self.between_modules:
            return "rename one of them, or make one LOCAL to its module"
        if self.of_own_module:
            return "rename the module: a controller may refuse to load it"
        return "rename one of them; names that differ only in case are the same name"


SKIPS = "skips the call"
LOOKS_FOR_IT = "looks for it among the modules it has loaded by then"
STOPS_THERE = "fails when it reaches the call"
"""Behaviour of a run at a call of a routine that no module declares."""

ASSUME = "`--assume-missing` skips calls of missing routines"


class UnknownRoutine(Violation, code="N209"):
    unknown: str
    nearest: str | None = None
    replacement: str = ""
    """Behaviour of a run at the call; empty if the program cannot run."""
    reserved: bool = False
    """Whether the nearest name is a reserved word."""
    is_function: bool = False
    foreign: str | None = None
    """RAPID's routine for a keyword of another robot language."""
    loads_modules: bool = False
    """Whether the task loads other modules while it runs."""

    @property
    def severity(self) -> Severity:
        """Error, unless unresolved references are allowed or assumed to exist."""
        return Severity.WARNING if self.replacement else Severity.ERROR

    @property
    def case(self) -> str:
        """Case of the rule by the kind of the routine and by the time of the failure."""
        kind = "function" if self.is_function else "procedure"
        return f"{kind}, reached" if self.replacement == STOPS_THERE else kind

    @property
    def message(self) -> str:
        """The name, and the behaviour of a run at its calls."""
        return (
            f"{super().message}; a run {self.replacement}" if self.replacement else super().message
        )

    @property
    def help(self) -> str:
        """Suggestion of the nearest routine, or of a declaration."""
        if self.foreign:
            return f"did you mean `{self.foreign}`, RAPID's word for it?"
        if self.loads_modules:
            return self._help_on_loading()
        if self.replacement == STOPS_THERE:
            return (
                "the task does not check references (-BindRef 0); "
                "include the module that declares it"
            )
        include = "include the module that declares it"
        if self.nearest:
            word = "the word " if self.reserved else ""
            meant = f"did you mean {word}`{self.nearest}`?"
            return f"{include}, or {meant}" if self.replacement else meant
        return include if self.replacement else f"{include}; {ASSUME}"

    def _help_on_loading(self) -> str:
        if self.is_function:
            late = "functions of loaded modules can be called where `check_references = false`"
        else:
            late = f'call a procedure of a loaded module by name: `%"{self.unknown}"%`'
        return f"did you mean `{self.nearest}`? Else {late}" if self.nearest else late


class UnknownType(Violation, code="N210"):
    unknown: str
    nearest: str | None = None
    allowed: bool = False
    """Whether unresolved references are allowed or assumed to exist."""

    @property
    def severity(self) -> Severity:
        """Error, unless unresolved references are allowed or assumed to exist."""
        return Severity.WARNING if self.allowed else Severity.ERROR

    @property
    def help(self) -> str:
        """Suggestion of the nearest type, or of a declaration."""
        where = "include the module that declares it"
        if self.nearest:
            meant = f"did you mean `{self.nearest}`?"
            return f"{where}, or {meant}" if self.allowed else meant
        return where if self.allowed else f"{where}; `--assume-missing` keeps such data as written"


class WrongKind(Violation, code="N211"):
    used: str
    kind: str
    wanted: str
    suggestion: str = ""

    @property
    def case(self) -> str:
        """Case of the rule by the expected kind."""
        return self.wanted.removeprefix("a ")


class ComponentOfUnknownType(Violation, code="N215"):
    record: str
    type_name: str
    component: str


class UnknownComponent(Violation, code="N212"):
    record: str
    component: str
    candidates: tuple[str, ...]
    nearest: str | None = None

    @property
    def help(self) -> str | None:
        """Suggestion of the nearest component, or all of them."""
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        return f"its components are {', '.join(self.candidates)}" if self.candidates else None


class MisplacedScope(Violation, code="N213"):
    word: str
    data: str
    storage: str = "VAR"

    @property
    def case(self) -> str:
        """Case of the rule by the keyword, and for LOCAL by the data."""
        if self.word == "LOCAL":
            return "constant" if self.storage == "CONST" else "variable"
        return "persistent" if self.word == "PERS" else self.word

    @property
    def help(self) -> str:
        """Suggestion of a valid place for the declaration."""
        if self.word == "PERS":
            return "declare it in the module, outside the routine"
        return f"leave out {self.word}, or declare it in the module, outside the routine"


class UnknownUnit(Violation, code="N214"):
    unit: str
    type: str


class NotInThisRobotWare(Violation, code="N219"):
    used: str
    since: str
    station: str


class AssumedData(Violation, code="N220"):
    missing: str
    type: str
    assumed: str

    @property
    def assumed_name(self) -> str:
        """The undeclared name."""
        return self.missing
