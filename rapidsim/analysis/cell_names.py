"""Names declared by the configuration of a cell: used in programs but declared by no module.

These are signals with their types, mechanical units and tasks. The station provides them; the
checker takes them as input, and a program keeps them, so that later queries resolve the same names.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field
from pathlib import PurePath

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
    """Symbols by folded name."""
    wired: frozenset[str] = frozenset()
    """Folded names that drive signals or follow them, and therefore are signals; their kind follows
    from their use.
    """
    robotware: RobotWare | None = None
    """Installed options; None if unspecified."""
    assumes: bool = False
    """Whether routines, types, signals, tools, work objects and loads that nothing declares are
    assumed to exist: calls are skipped, tools are predefined ones.
    """
    stubs: frozenset[str] = frozenset()
    """Files whose routines are stubs of libraries that are not available."""
    places_parts: bool = False
    """Whether the station defines the positions of parts for searches with a torch."""
    has_signals: bool = False
    """Whether the cell declares its signals: a controller would have no others."""
    unseen: tuple[str, ...] = ()
    """Modules of the task that cannot be read here, so that their declarations are unknown."""
    refers_late: bool = False
    """Whether the task is loaded with unresolved references, which a run detects when it reaches
    one.
    """

    @property
    def stops_at_unresolved(self) -> bool:
        """Whether calls of undeclared routines fail, as no unread module may declare them."""
        return self.refers_late and not self.unseen

    def is_unread(self, module: str) -> bool:
        """Whether a module of the task cannot be read here; its file has its name."""
        files = (PurePath(one.partition(" (")[0]) for one in self.unseen)
        return module.strip().lower() in (file.stem.lower() for file in files)

    def find(self, key: str) -> ConfiguredSymbol | None:
        """Return the symbol of a folded name."""
        return self.symbols.get(key)


NO_CELL = CellNames()
"""Names of a cell without configuration."""


def cell_names(
    signals: Iterable[tuple[str, Type]],
    units: Iterable[str] = (),
    tasks: Iterable[str] = (),
    cameras: Iterable[str] = (),
    wired: Iterable[str] = (),
) -> CellNames:
    """Return the names that a configuration declares.

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
