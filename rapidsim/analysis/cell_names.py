"""Names declared by the configuration of a cell: used in programs but declared by no module.

Signals with their types, mechanical units, tasks. The station provides them; the checker takes them
in, and a program keeps them, so that later queries know the same names.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field

from rapidsim.language.robotware import RobotWare
from rapidsim.language.types import Type
from rapidsim.library.predefined import TYPES
from rapidsim.values import value_class


@value_class(frozen=True, eq=False, slots=True)
class ConfiguredSymbol:
    """A signal, mechanical unit or task that the configuration of the cell declares."""

    name: str
    type: Type


@value_class(frozen=True, slots=True)
class CellNames:
    """The configured names of a cell."""

    symbols: Mapping[str, ConfiguredSymbol] = field(default_factory=dict)
    """By folded name."""
    wired: frozenset[str] = frozenset()
    """Folded names that drive signals or follow them, so that they are signals; of which kind,
    the use tells."""
    robotware: RobotWare | None = None
    """What its controller has; None where nobody says."""
    assumes: bool = False
    """Whether routines, types, signals, tools, work objects and loads that nothing declares are
    assumed to exist: calls are skipped, tools are those of the system."""
    stubs: frozenset[str] = frozenset()
    """Files whose routines stand for libraries that are not here."""
    places_parts: bool = False
    """Whether the station says where parts are that a torch searches."""
    has_signals: bool = False
    """Whether it declares its signals: a controller would have no others."""
    unseen: tuple[str, ...] = ()
    """Modules that the task has and nobody can read here: what they declare is not known."""
    refers_late: bool = False
    """Whether the task is loaded with references that nothing declares: a run finds out when it
    comes to one."""

    @property
    def stops_at_unresolved(self) -> bool:
        """Whether a call of what nothing declares fails; a module not seen here may declare it."""
        return self.refers_late and not self.unseen

    def find(self, key: str) -> ConfiguredSymbol | None:
        """The symbol of a folded name."""
        return self.symbols.get(key)


NO_CELL = CellNames()
"""Where nothing is known of the cell."""


def cell_names(
    signals: Iterable[tuple[str, Type]],
    units: Iterable[str] = (),
    tasks: Iterable[str] = (),
    cameras: Iterable[str] = (),
    wired: Iterable[str] = (),
) -> CellNames:
    """The names that a configuration declares.

    Args:
        signals: Names and types of signals.
        units: Names of mechanical units.
        tasks: Names of tasks; each is predeclared as a `taskid`, such as `T_ROB1Id`.
        cameras: Names of cameras.
        wired: Names of signals that connections and stimuli mention.
    """
    declared = [
        *((f"{task}Id", TYPES["taskid"]) for task in tasks),
        *((unit, TYPES["mecunit"]) for unit in units),
        *((camera, TYPES["cameradev"]) for camera in cameras),
        *signals,
    ]
    symbols = {name.lower(): ConfiguredSymbol(name, of) for name, of in declared}
    return CellNames(symbols, frozenset(name.lower() for name in wired) - symbols.keys())
