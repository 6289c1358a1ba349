"""Table of all installed routines: the chapters of the library, then the declared routines.

A user's name hides an installed one, so this table is searched last.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from rapidsim.library.arc import ARC
from rapidsim.library.axis_signals import AXIS_SIGNALS
from rapidsim.library.bits import BITS
from rapidsim.library.cameras import CAMERAS
from rapidsim.library.configuration import CONFIGURATION
from rapidsim.library.conveyors import CONVEYORS
from rapidsim.library.corrections import CORRECTIONS
from rapidsim.library.cyclic_bools import CYCLIC_BOOLS
from rapidsim.library.declared import read_declared
from rapidsim.library.dialogs import DIALOGS
from rapidsim.library.displacement import DISPLACEMENT
from rapidsim.library.error_interrupts import ERROR_INTERRUPTS
from rapidsim.library.errors import ERRORS
from rapidsim.library.file_system import FILE_SYSTEM
from rapidsim.library.file_times import FILE_TIMES
from rapidsim.library.files import FILES
from rapidsim.library.fits import FITS
from rapidsim.library.flow import FLOW
from rapidsim.library.guidance import GUIDANCE
from rapidsim.library.independent_axes import INDEPENDENT_AXES
from rapidsim.library.interrupts import INTERRUPTS
from rapidsim.library.io_devices import IO_DEVICES
from rapidsim.library.loading import LOADING
from rapidsim.library.mathematics import MATHEMATICS
from rapidsim.library.matrices import MATRICES
from rapidsim.library.mechanical_units import MECHANICAL_UNITS
from rapidsim.library.messages import MESSAGES
from rapidsim.library.motion import MOTION
from rapidsim.library.motion_settings import MOTION_SETTINGS
from rapidsim.library.operator import OPERATOR
from rapidsim.library.output_moves import OUTPUT_MOVES
from rapidsim.library.path_length import PATH_LENGTH
from rapidsim.library.path_recorder import PATH_RECORDER
from rapidsim.library.positions import POSITIONS
from rapidsim.library.raw_bytes import RAW_BYTES
from rapidsim.library.robot_state import ROBOT_STATE
from rapidsim.library.search import SEARCH
from rapidsim.library.signal_waits import SIGNAL_WAITS
from rapidsim.library.signals import SIGNALS
from rapidsim.library.smart_gripper import SMART_GRIPPER
from rapidsim.library.sockets import SOCKETS
from rapidsim.library.stop_start import STOP_START
from rapidsim.library.strings import STRINGS
from rapidsim.library.symbols import SYMBOLS
from rapidsim.library.system_data import SYSTEM_DATA
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.tactile_search import TACTILE_SEARCH
from rapidsim.library.tasks import TASKS
from rapidsim.library.text_tables import TEXT_TABLES
from rapidsim.library.timing import TIMING
from rapidsim.library.trigger_moves import TRIGGER_MOVES
from rapidsim.library.trigger_outputs import TRIGGER_OUTPUTS
from rapidsim.library.triggers import TRIGGERS
from rapidsim.library.world_zones import WORLD_ZONES

CHAPTERS: Mapping[str, Mapping[str, LibraryRoutine]] = MappingProxyType(
    {
        "Motion": MOTION,
        "Motion settings": MOTION_SETTINGS,
        "Displacement": DISPLACEMENT,
        "Robot state": ROBOT_STATE,
        "Positions": POSITIONS,
        "Signals": SIGNALS,
        "Signal waits": SIGNAL_WAITS,
        "Timing": TIMING,
        "Interrupts": INTERRUPTS,
        "Interrupts by errors": ERROR_INTERRUPTS,
        "Triggers": TRIGGERS,
        "Moves with triggers": TRIGGER_MOVES,
        "Moves with named outputs": TRIGGER_OUTPUTS,
        "Moves with outputs": OUTPUT_MOVES,
        "Search": SEARCH,
        "Stop and start": STOP_START,
        "Path recorder": PATH_RECORDER,
        "Path length": PATH_LENGTH,
        "World zones": WORLD_ZONES,
        "Tasks": TASKS,
        "Flow": FLOW,
        "Errors": ERRORS,
        "Operator": OPERATOR,
        "Dialogs": DIALOGS,
        "Text tables": TEXT_TABLES,
        "Files": FILES,
        "Files and folders": FILE_SYSTEM,
        "Times of files": FILE_TIMES,
        "Loading modules": LOADING,
        "Raw bytes": RAW_BYTES,
        "Message queues": MESSAGES,
        "Sockets": SOCKETS,
        "Mathematics": MATHEMATICS,
        "Matrices": MATRICES,
        "Best fits": FITS,
        "Bits": BITS,
        "Strings": STRINGS,
        "Data by name": SYMBOLS,
        "System data": SYSTEM_DATA,
        "Configuration": CONFIGURATION,
        "I/O devices": IO_DEVICES,
        "Mechanical units": MECHANICAL_UNITS,
        "Test signals": AXIS_SIGNALS,
        "Path correction": CORRECTIONS,
        "Externally guided motion": GUIDANCE,
        "Cyclic bools": CYCLIC_BOOLS,
        "Cameras": CAMERAS,
        "Conveyors": CONVEYORS,
        "Independent axes": INDEPENDENT_AXES,
        "Arc welding": ARC,
        "Tactile search": TACTILE_SEARCH,
        "Gripper of the IRB 14000": SMART_GRIPPER,
    }
)
"""The routines written in Python, by chapter."""


class _Catalogue(Mapping[str, LibraryRoutine]):
    """Mapping that reads the declared routines on the first lookup outside the chapters."""

    def __init__(self) -> None:
        self._written = {key: row for chapter in CHAPTERS.values() for key, row in chapter.items()}

    def __getitem__(self, key: str) -> LibraryRoutine:
        found = self._written.get(key)
        return read_declared()[key] if found is None else found

    def __iter__(self) -> Iterator[str]:
        yield from self._written
        yield from read_declared()

    def __len__(self) -> int:
        return len(self._written) + len(read_declared())


ROUTINES: Mapping[str, LibraryRoutine] = _Catalogue()
"""Every installed routine by folded name."""
