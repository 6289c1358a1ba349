"""Rules N2: names that are undeclared, ambiguous, or of the wrong kind."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class UndefinedName(Violation, code="N201"):
    undefined: str
    nearest: str | None = None
    reserved: bool = False
    """Whether the nearest is a word of the language."""
    loads_modules: bool = False
    """Whether the task takes in other modules while it runs."""
    may_be_signal: bool = False
    """Whether it stands where the value of a signal may."""

    @property
    def help(self) -> str:
        """The nearest name, or where to declare one."""
        if self.nearest and self.reserved:
            return f"did you mean the word {self.nearest}?"
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        if self.loads_modules:
            return "read data of a module that is loaded while the program runs with GetDataVal"
        declare = "declare it, or check the module that declares it together with this one"
        if self.may_be_signal:
            return f"{declare}; if it is a signal, declare it in [signals] of rapidsim.toml"
        return declare


class UnseenName(Violation, code="N216"):
    undefined: str
    modules: tuple[str, ...]

    @property
    def help(self) -> str:
        """Where it may be declared."""
        return f"it may be declared in {' or '.join(self.modules)}, which cannot be read here"


class UnresolvedReference(Violation, code="N221"):
    undefined: str


class DuplicateName(Violation, code="N202"):
    duplicate: str
    where: str = ""
    between_modules: bool = False
    is_module: bool = False

    @property
    def help(self) -> str:
        """What tells the names apart."""
        if self.is_module:
            return (
                "files named together form one task: leave out the copy, or name "
                "each program by itself"
            )
        if self.between_modules and self.duplicate.lower() == "main":
            return (
                "files named together form one task: name each program separately, or let "
                "`rapidsim init` give each a [[task]] in rapidsim.toml"
            )
        if self.between_modules:
            return "rename one of them, or make one LOCAL to its module"
        return "rename one of them; names that differ only in case are the same name"


SKIPS = "skips the call"
LOOKS_FOR_IT = "looks for it among the modules it has loaded by then"
STOPS_THERE = "fails where it comes to the call (40130)"
"""What a run does with the call of a routine that no module declares."""


class UnknownRoutine(Violation, code="N209"):
    unknown: str
    nearest: str | None = None
    instead: str = SKIPS
    """What a run does with the call."""
    reserved: bool = False
    """Whether the nearest is a word of the language."""

    @property
    def help(self) -> str:
        """Where the routine may be declared, or which one may be meant."""
        if self.instead == STOPS_THERE:
            return (
                "the task does not check references (-BindRef 0); "
                "include the module that declares it"
            )
        if self.instead != SKIPS:
            return (
                f'a module that is loaded by then may declare it; `%"{self.unknown}"%` says so, '
                "and is called where a controller refuses unresolved references"
            )
        word = "the word " if self.reserved else ""
        or_slip = f", or did you mean {word}`{self.nearest}`?" if self.nearest else ""
        return f"include the module that declares it{or_slip}"


class UnknownType(Violation, code="N210"):
    unknown: str
    nearest: str | None = None

    @property
    def help(self) -> str:
        """Where the type may be declared, or which one may be meant."""
        where = "include the module that declares it, if it is not the type of an option"
        return f"{where}; or did you mean `{self.nearest}`?" if self.nearest else where


class WrongKind(Violation, code="N211"):
    used: str
    kind: str
    wanted: str
    cure: str = ""


class ComponentOfUnknownType(Violation, code="N215"):
    record: str
    type_name: str
    component: str


class UnknownComponent(Violation, code="N212"):
    record: str
    component: str
    known: tuple[str, ...]
    nearest: str | None = None

    @property
    def help(self) -> str | None:
        """The nearest component, or all of them."""
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        return f"its components are {', '.join(self.known)}" if self.known else None


class MisplacedScope(Violation, code="N213"):
    word: str
    data: str

    @property
    def help(self) -> str:
        """Where such data must be declared."""
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
    taken: str
