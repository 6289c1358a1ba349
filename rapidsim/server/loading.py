"""Load files and create an engine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from rapidsim.analysis.names.signal_violations import UnknownSignal
from rapidsim.controller.cell.description import SignalDeclaration, SignalKind
from rapidsim.controller.cell.external_streams import NullWire, Wire
from rapidsim.controller.cell.sensors import GuidanceSensors, NoSensors
from rapidsim.diagnostics import Diagnostic
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import LoadedJob, PreparedRun, loaded, prepared
from rapidsim.language.robotware import RobotWare
from rapidsim.server.derived_parameters import is_guided, with_derived
from rapidsim.server.engine import Engine, FullPace, LockStep, Pace, WallPace
from rapidsim.server.messages import Notification
from rapidsim.server.sensors import RecordingSensors
from rapidsim.server.settings import EngineSettings
from rapidsim.server.versions import served_versions
from rapidsim.server.wire import RecordingWire
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class ReadyController:
    """A program that can be served."""

    setups: tuple[TaskSetup, ...]
    options: RunOptions
    home: Path
    ramdisk: Path
    notes: tuple[str, ...] = ()
    """Remarks on a backup or a robot."""
    robotware: RobotWare | None = None
    """Version of the station or backup; None if it names none."""

    @property
    def is_guided(self) -> bool:
        """Whether a program is written for sensors that guide its robot."""
        return is_guided(self.setups)


def ready(request: RunRequest) -> ReadyController:
    """Load and check a program as `rapidsim run` does.

    Undeclared signals that the program uses are added to its cell.

    Raises:
        ProgramRejectedError: If checking finds an error.
        InputError: If an input is missing.
    """
    found = loaded(job(request))
    return with_cell(found, prepared(found))


def with_cell(loaded_job: LoadedJob, made: PreparedRun) -> ReadyController:
    """Prepare a loaded program for a served controller."""
    io = made.options.io
    undeclared = _undeclared(loaded_job.diagnostics)
    known = {one.name.lower() for one in io.signals}
    fresh = tuple(one for key, one in undeclared.items() if key not in known)
    home = made.options.home or Path("HOME")
    signals = (*io.signals, *fresh)
    # There is no operator at a terminal to answer.
    options = replace(
        made.options, io=replace(io, signals=signals), home=home, answers=None, network=None
    )
    options = replace(options, configured=with_derived(made.setups, options))
    notices = loaded_job.robot.notices
    ramdisk = options.ramdisk or home / "RAMDISK"
    return ReadyController(
        made.setups,
        options,
        home.resolve(),
        ramdisk.resolve(),
        (*loaded_job.job.station.remarks, *notices),
        loaded_job.job.station.robotware,
    )


def engine_of(
    controller: ReadyController,
    settings: EngineSettings,
    on_notification: Callable[[Notification], None],
    journal: Callable[[str], None] | None = None,
    wire: Wire | None = None,
    sensors: GuidanceSensors | None = None,
) -> Engine:
    """Switch a controller on and return its engine.

    Args:
        controller: Its programs and cell.
        settings: Its initial state and pace.
        on_notification: Receives the notifications of the engine.
        journal: Receives each line of the journal.
        wire: The network of the programs' sockets; None for none.
        sensors: The sensors that guide robots; None for none.

    Raises:
        InputError: If an arm cannot be timed, or no task moves one.
    """
    live = LiveController(
        controller.setups,
        controller.options,
        motors=settings.motors,
        mode=settings.mode,
        wire=RecordingWire(wire or NullWire()),
        sensors=RecordingSensors(sensors or NoSensors()),
    )
    versions = served_versions(controller.robotware, settings.robotware)
    return Engine(live, _pace(settings), on_notification, journal, versions)


def _pace(settings: EngineSettings) -> Pace:
    if settings.request_s is not None:
        return LockStep(settings.request_s)
    return FullPace() if settings.speed is None else WallPace(settings.speed)


def _undeclared(findings: tuple[Diagnostic, ...]) -> dict[str, SignalDeclaration]:
    """Return the undeclared signals that programs use, by folded name."""
    signals = {}
    for one in findings:
        violation = one.violation
        if isinstance(violation, UnknownSignal) and violation.type.startswith("signal"):
            kind = SignalKind(violation.type.removeprefix("signal"))
            signals[violation.signal.lower()] = SignalDeclaration(violation.signal, kind)
    return signals
