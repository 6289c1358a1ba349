"""The engine in its own process, and the link to it."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import field
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess
from pathlib import Path
from queue import SimpleQueue
from threading import Thread
from time import monotonic
from typing import Final, Protocol, TypeAlias

from rapidsim.controller.cell.sensors import GuidanceSensors
from rapidsim.egm.devices import sensor_devices
from rapidsim.egm.guided_sensors import GuidedSensors
from rapidsim.egm.sensor_loop import run_sensor_loop
from rapidsim.egm.udp import PacedSensors, StepSensors
from rapidsim.files import InputError
from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import ProgramRejectedError
from rapidsim.motion.robot.robot import RobotError
from rapidsim.server.engine import Engine, WallPace
from rapidsim.server.journal import JournalFile
from rapidsim.server.link import EngineEndedError
from rapidsim.server.loading import engine_of, ready
from rapidsim.server.memory import give_large_blocks_back
from rapidsim.server.messages import ConsoleLine, Inquiry, Notification, Reply
from rapidsim.server.settings import EngineSettings
from rapidsim.server.wire import SocketWire
from rapidsim.syntax.garbage_collection import gc_for_server
from rapidsim.values import value_class

_LOOKS_S: Final = 0.001
"""Time [s] for which an engine runs before it checks for messages."""
_PATIENCE_S: Final = 5.0
"""Time [s] in which an engine must end."""


class DebuggerPort(Protocol):
    """A port for a debugger, in the engine's process."""

    @property
    def address(self) -> str:
        """Host and port."""
        ...

    def sockets(self) -> Sequence[socket.socket]:
        """The sockets that may have something to read."""
        ...

    def came(self, readable: Sequence[object]) -> None:
        """Handle what has arrived at these sockets."""
        ...

    def close(self) -> None:
        """Close the port."""
        ...


OpenDebugPort: TypeAlias = Callable[[Engine], DebuggerPort]


@value_class(frozen=True, slots=True)
class SwitchedOn:
    """The controller is switched on."""

    home: Path
    ramdisk: Path
    sensors: Mapping[str, str]
    """Addresses of sensors that guide robots, by the names of their devices."""
    is_guided: bool
    """Whether a further process is needed that exchanges messages with sensors."""
    debug: str | None
    """Address of the port for a debugger."""


Start: TypeAlias = SwitchedOn | ProgramRejectedError | InputError
"""Outcome of switching a controller on."""


@value_class(eq=False)
class EngineProcess:
    """An engine in a child process; see `started`."""

    ready: SwitchedOn
    _connection: Connection
    _process: SpawnProcess
    listener: Callable[[Notification], None] = print
    """Receives the notifications of the engine, in the loop's thread; set before `attach`."""
    ended: asyncio.Event = field(default_factory=asyncio.Event)
    """Set when the engine has ended."""
    _waiting: dict[int, asyncio.Future[Reply]] = field(default_factory=dict)
    _last: int = 0
    _outgoing: SimpleQueue[object] = field(default_factory=SimpleQueue)

    def attach(self) -> None:
        """Start transferring messages in both directions; called in the loop."""
        loop = asyncio.get_running_loop()
        Thread(target=self._send, name="rapidsim to the engine", daemon=True).start()
        receive = Thread(
            target=self._receive, args=(loop,), name="rapidsim from the engine", daemon=True
        )
        receive.start()

    async def request(self, message: Inquiry) -> Reply:
        """See `link.Link`."""
        if self.ended.is_set():
            raise EngineEndedError
        self._last += 1
        number = self._last
        future: asyncio.Future[Reply] = asyncio.get_running_loop().create_future()
        self._waiting[number] = future
        self._outgoing.put((number, message))
        return await future

    def end(self) -> None:
        """Switch the controller off, which stops its robots."""
        self._outgoing.put(None)
        _await_end(self._process)

    def _send(self) -> None:
        with suppress(OSError, ValueError):
            while True:
                sent = self._outgoing.get()
                self._connection.send(sent)
                if sent is None:
                    return

    def _receive(self, loop: asyncio.AbstractEventLoop) -> None:
        with suppress(EOFError, OSError, RuntimeError):
            while True:
                number, told = self._connection.recv()
                loop.call_soon_threadsafe(self._received, number, told)
        with suppress(RuntimeError):
            loop.call_soon_threadsafe(self._lost)

    def _received(self, number: int | None, message: object) -> None:
        if number is None:
            self.listener(message)  # type: ignore[arg-type]
            return
        future = self._waiting.pop(number, None)
        if future is not None and not future.done():
            future.set_result(message)  # type: ignore[arg-type]

    def _lost(self) -> None:
        self.ended.set()
        for future in self._waiting.values():
            if not future.done():
                future.set_exception(EngineEndedError())
        self._waiting.clear()


def started(
    request: RunRequest, settings: EngineSettings, open_debug_port: OpenDebugPort | None = None
) -> EngineProcess:
    """Load a program and switch a controller on in its own process.

    Args:
        request: The program.
        settings: The initial state of the controller.
        open_debug_port: Opens a port for a debugger, which must be possible to pickle; None for no
            port.

    Raises:
        ProgramRejectedError: If checking finds an error.
        InputError: If an input is missing.
    """
    context = get_context("spawn")
    ours, theirs = context.Pipe()
    to_guide, of_guide = context.Pipe()
    arguments = (theirs, to_guide, request, settings, open_debug_port)
    process = context.Process(target=_run, args=arguments, daemon=True)
    process.start()
    theirs.close()
    to_guide.close()
    try:
        start: Start = ours.recv()
    except EOFError:
        _await_end(process)
        of_guide.close()
        raise InputError("the controller's process has ended before it was there") from None
    if isinstance(start, SwitchedOn):
        if start.is_guided:
            context.Process(target=run_sensor_loop, args=(of_guide,), daemon=True).start()
        of_guide.close()
        return EngineProcess(start, ours, process)
    of_guide.close()
    ours.close()
    _await_end(process)
    raise start


def _await_end(process: SpawnProcess) -> None:
    process.join(_PATIENCE_S)
    if process.is_alive():
        process.kill()


def _run(
    connection: Connection,
    to_guide: Connection,
    request: RunRequest,
    settings: EngineSettings,
    open_debug_port: OpenDebugPort | None,
) -> None:
    """Run the engine's process until its parent commands the end, or is gone."""
    # Ctrl-C reaches all processes of a terminal; the parent decides when to end.
    for name in ("SIGINT", "SIGTERM"):
        signal.signal(getattr(signal, name), signal.SIG_IGN)
    give_large_blocks_back()
    with suppress(EOFError, BrokenPipeError, ConnectionResetError):
        try:
            made = ready(request)
            kept = None
            if settings.journal is not None:
                kept = JournalFile(
                    settings.journal, lambda text: connection.send((None, ConsoleLine(text)))
                )
            wire = SocketWire(settings.hosts)
            is_guided = settings.request_s is None and settings.speed is not None and made.is_guided
            devices = sensor_devices(
                settings.sensors,
                made.options.configured,
                settings.hosts,
                any_port=settings.any_sensor_port,
            )
            steps = StepSensors(devices)
            paced: GuidanceSensors = PacedSensors(devices, waits_full=False)
            if settings.request_s is not None:
                paced = steps
            elif is_guided and settings.speed is not None:
                paced = GuidedSensors(devices, to_guide, settings.speed)
            engine = engine_of(
                made,
                settings,
                lambda told: connection.send((None, told)),
                None if kept is None else kept.write,
                wire,
                paced,
            )
            if isinstance(paced, GuidedSensors) and isinstance(engine.pace, WallPace):
                paced.began_s = engine.pace.began_s
            wire.unread = engine.live.external_streams.unread
            debug_port = None if open_debug_port is None else open_debug_port(engine)
            _record(engine, settings, lambda text: connection.send((None, ConsoleLine(text))))
        except (ProgramRejectedError, InputError) as error:
            connection.send(error)
            return
        except RobotError as error:
            connection.send(InputError(str(error)))
            return
        address = None if debug_port is None else debug_port.address
        connection.send(SwitchedOn(made.home, made.ramdisk, devices.addresses, is_guided, address))
        for note in made.notes:
            connection.send((None, ConsoleLine(f"note: {note}")))
        with recursion_limit(RUNNING_DEPTH), gc_for_server():
            _serve(connection, engine, wire, steps, debug_port)
        if debug_port is not None:
            debug_port.close()
        engine.switch_off()
        wire.shut()
        if kept is not None:
            kept.close()
    sys.stdout.flush()
    # All files are whole; to take Python down object by object costs seconds on a busy computer.
    os._exit(0)


def _record(engine: Engine, settings: EngineSettings, failed: Callable[[str], None]) -> None:
    if settings.record is None:
        return
    # The recording library is slow to load, and not everybody has it.
    from rapidsim.recording.live_recording import LiveRecording  # noqa: PLC0415
    from rapidsim.server.recorder import LiveRecorder  # noqa: PLC0415

    recording = LiveRecording(settings.record, settings.view)
    recorder = LiveRecorder(engine.live, recording, failed)
    recorder.begin()
    engine.record(recorder)


def _serve(
    connection: Connection,
    engine: Engine,
    wire: SocketWire,
    sensors: StepSensors,
    debug_port: DebuggerPort | None,
) -> None:
    while True:
        # A check for messages costs as much as a few milliseconds of a task's execution.
        until_s = monotonic() + _LOOKS_S
        while (stepped := engine.step()) and monotonic() < until_s:
            pass
        wait_s = 0.0 if stepped else engine.wait_s()
        sockets = [*wire.sockets(), *sensors.sockets()]
        if debug_port is not None:
            sockets += debug_port.sockets()
        heard = wait([connection, *sockets], wire.patience_s(wait_s))
        if debug_port is not None:
            debug_port.came(heard)
        if passed_s := sensors.came(heard):
            engine.sensor_answered(passed_s)
        for one in wire.came(heard):
            engine.reply(one)
        while connection in heard:
            received = connection.recv()
            if received is None:
                return
            number, message = received
            connection.send((number, engine.reply(message)))
            if not connection.poll():
                break
