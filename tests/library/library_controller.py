"""A controller that records what routines ask of it, and a way to call routines by name."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from datetime import datetime, timedelta
from typing import Any, cast

from memory_file import MemoryFile
from no_sockets import NoSockets
from parts_at_rest import PartsAtRest
from undisturbed import Undisturbed

from rapidsim.diagnostics import Source, Span
from rapidsim.language.cameras import Camera
from rapidsim.language.controller import Controller, Motion
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    TOOL0,
    WOBJ0,
    ConfData,
    JointTarget,
    Orient,
    Pos,
    Pose,
    RobJoint,
    RobTarget,
    SpeedData,
    ToolData,
    WobjData,
)
from rapidsim.language.equipment import Conveyor, IndependentAxis, MechanicalUnitFacts
from rapidsim.language.error_log import LoggedError
from rapidsim.language.error_numbers import (
    ERR_FILEOPEN,
    ERR_FILNOTFND,
    ERR_OUTSIDE_REACH,
    rapid_error,
)
from rapidsim.language.errors import Stopped
from rapidsim.language.files import FileMode
from rapidsim.language.guidance import Guidance
from rapidsim.language.messages import Messages
from rapidsim.language.modules import Modules
from rapidsim.language.moves import Flank, MotionSettings, Move, Place, SearchStop
from rapidsim.language.option_data import CameraTarget, RestartData
from rapidsim.language.path_events import Trigger, ZoneShape
from rapidsim.language.reference import Reference
from rapidsim.language.symbols import Symbols
from rapidsim.library.catalogue import ROUTINES

CONF = ConfData(0.0, 0.0, 0.0, 0.0)
HOME = RobTarget(Pos(500.0, 0.0, 800.0), Orient(0.0, 0.0, 1.0, 0.0), CONF, NO_EXTERNAL_AXES)
JOINTS = JointTarget(RobJoint(0.0, 10.0, 20.0, 0.0, 30.0, 0.0), NO_EXTERNAL_AXES)


def call(name: str, *arguments: Any, **options: Any) -> Any:
    """Call a routine that needs no controller."""
    return ROUTINES[name.lower()].body(*arguments, **options)


@dataclass
class RecordingController(NoSockets, PartsAtRest, Undisturbed):
    """Implements all protocols of `language.controller` with nothing behind it."""

    time_s: float = 0.0
    errno: float = 0.0
    retries: int = 0
    handler: float = 0.0
    intno: float = 0.0
    place: Place = field(default_factory=lambda: Place(Span(Source("", ""), 0, 0), "main"))
    settings: MotionSettings = field(default_factory=MotionSettings)
    moves: list[Move] = field(default_factory=list)
    triggers: tuple[Trigger, ...] = ()
    path_level: float = 1.0
    symbols: Symbols = field(init=False)
    modules: Modules = field(init=False)
    log: list[str] = field(default_factory=list)
    unsimulated: list[tuple[str, str]] = field(default_factory=list)
    signals: dict[str, float] = field(default_factory=dict)
    files: dict[str, bytearray] = field(default_factory=dict)
    text_tables: dict[str, dict[int, str]] = field(default_factory=dict)
    corrections: dict[int, Pos] = field(default_factory=dict)
    cyclic: dict[str, Callable[[], bool]] = field(default_factory=dict)
    disabled: set[str] = field(default_factory=set)
    number: float = 0.0
    choice: int = 0
    text: str = ""
    nobody: bool = False
    """Whether nobody answers a question that ends by itself."""
    booked: float = 20500.0
    in_reach: bool = True

    def __post_init__(self) -> None:
        self.call_procedure: Callable[[str], None] = print
        self.part_pose: Callable[[str], Pose | None] = lambda _: None
        self.program_state: Callable[[], Iterable[object]] = lambda: (None,)

    def call(self, name: str, *arguments: Any, **options: Any) -> Any:
        """Call a routine, with this controller if it wants one."""
        row = ROUTINES[name.lower()]
        first = (row.signature.concern_of(self.whole()),) if row.signature.takes_controller else ()
        return row.body(*first, *arguments, **options)

    def whole(self) -> Controller:
        """All concerns in one; mypy holds it against the protocol of most."""
        whole = Controller(
            *(self, self, cast(Motion, self), self, self, self, self, self, self, self, self, self),
            *(self, self, self, self, self, self, self, self, self, self, self, self),
            cast(Messages, self),
            cast(Guidance, self),
        )
        for name in (one for one in ("symbols", "modules") if hasattr(self, one)):
            setattr(whole, name, getattr(self, name))
        return whole

    def now(self) -> float:
        return self.time_s

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        self.time_s += seconds
        self.log.append(f"wait {seconds:g}{' in position' if in_position else ''}")

    def long_work(self) -> AbstractContextManager[None]:
        return nullcontext()

    def wait_until(
        self, condition: Callable[[], bool], *, max_time: float | None = None, poll_s: float = 0.1
    ) -> bool:
        self.log.append(f"wait until, max {max_time}, every {poll_s:g}")
        return condition()

    def tick(self) -> None:
        """No time passes here."""

    def service(self) -> None:
        raise AssertionError("nothing is due here")

    def move(self, move: Move, triggers: tuple[Trigger, ...] = ()) -> None:
        self.moves.append(move)
        self.triggers += triggers

    def stop(self, reason: str, *, every: bool = False) -> None:
        raise Stopped(reason)

    def supervise(
        self, restart: Reference[RestartData], process: tuple[str | None, ...], shadow: str
    ) -> None:
        raise AssertionError("stops are tested with a run around them")

    def stop_move(self, *, quick: bool = False) -> None:
        self.log.append("stop")

    def start_move(self) -> None:
        self.log.append("start")

    def is_stopped(self) -> bool:
        return self.log[-1:] == ["stop"]

    def clear_path(self) -> None:
        self.log.append("clear path")

    def store_path(self, *, keep_sync: bool = False) -> None:
        self.path_level += 1.0

    def restore_path(self) -> None:
        self.path_level -= 1.0

    def search(
        self, move: Move, found: Callable[[], float] | str, flank: Flank, stop: SearchStop
    ) -> RobTarget:
        self.moves.append(move)
        what = found if isinstance(found, str) else f"{found():g}"
        self.log.append(f"search {what}, {flank.value}, {stop.value}")
        return HOME

    def search_joints(
        self, move: Move, found: Callable[[], float] | str, flank: Flank, stop: SearchStop
    ) -> JointTarget:
        self.search(move, found, flank, stop)
        return JOINTS

    def watch_zone(
        self, shape: ZoneShape, signal: tuple[str, float] | None, *, before: bool = False
    ) -> float:
        self.log.append(f"zone {shape.volume} {'outside' if shape.outside else ''}{signal or ''}")
        return 7.0

    def enable_zone(self, zone: float, *, enabled: bool) -> None:
        self.log.append(f"zone {zone:g} {'on' if enabled else 'off'}")

    def free_zone(self, zone: float) -> None:
        self.log.append(f"zone {zone:g} free")

    def current_joints(self) -> JointTarget:
        return JOINTS

    def current_speeds(self) -> JointTarget:
        return JOINTS

    def is_moving(self) -> bool:
        return False

    def mechanical_units(self) -> tuple[MechanicalUnitFacts, ...]:
        return (MechanicalUnitFacts("ROB_1", True, (0, 1, 2, 3, 4, 5)),)

    def system_units(self) -> tuple[MechanicalUnitFacts, ...]:
        return self.mechanical_units()

    def instances(self, domain: str, of: str) -> Sequence[Mapping[str, str]] | None:
        return None

    def configure(self, domain: str, of: str, number: int, attribute: str, value: str) -> None:
        raise AssertionError("there are no system parameters here")

    def set_up(
        self, name: str, flag: Reference[bool], condition: Callable[[], bool], signal: str | None
    ) -> None:
        self.cyclic[name] = condition

    def remove(self, name: str) -> None:
        self.cyclic.pop(name, None)

    def names(self) -> tuple[str, ...]:
        return tuple(self.cyclic)

    def conveyor(self, unit: str) -> Conveyor | None:
        return None

    def independent_axis(self, unit: MechanicalUnitFacts, axis: int) -> IndependentAxis:
        raise NotImplementedError

    def camera(self, name: str) -> Camera | None:
        return None

    def take_picture(self, camera: Camera) -> float:
        raise AssertionError("there are no cameras here")

    def result_count(self, camera: Camera) -> int:
        raise AssertionError("there are no cameras here")

    def fetch(self, camera: Camera) -> CameraTarget | None:
        raise AssertionError("there are no cameras here")

    def expects(self, camera: Camera) -> bool:
        raise AssertionError("there are no cameras here")

    def forget(self, camera: Camera) -> None:
        raise AssertionError("there are no cameras here")

    def is_enabled(self, device: str) -> bool:
        return device.lower() not in self.disabled

    def enable(self, device: str, *, enabled: bool) -> None:
        (self.disabled.discard if enabled else self.disabled.add)(device.lower())

    def current_target(self, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        return HOME

    def active_tool(self) -> ToolData:
        return TOOL0

    def active_wobj(self) -> WobjData:
        return WOBJ0

    def active_names(self) -> tuple[str, str]:
        return "tool0", "wobj0"

    def activate(self, data: ToolData | WobjData, name: str) -> None:
        self.log.append(f"active {name}")

    def programmed_end(self, tool: ToolData, wobj: WobjData) -> RobTarget:
        return self.current_target(tool, wobj)

    def target_at(self, joints: JointTarget, tool: ToolData, wobj: WobjData) -> RobTarget:
        return HOME

    def joints_at(self, target: RobTarget, tool: ToolData, wobj: WobjData) -> JointTarget:
        if not self.in_reach:
            raise rapid_error(ERR_OUTSIDE_REACH, "too far")
        return JOINTS

    def show(self, text: str) -> None:
        self.log.append(f"show {text}")

    def clear_screen(self) -> None:
        self.log.append("clear")

    has_answered = False

    def asking(self, instruction: str) -> AbstractContextManager[None]:
        del instruction
        return nullcontext()

    def ask_number(self, prompt: str, *, ends: bool = False) -> float | None:
        self.log.append(f"number? {prompt}")
        return None if ends and self.nobody else self.number

    def ask_choice(self, prompt: str, choices: Sequence[str], *, ends: bool = False) -> int | None:
        self.log.append(f"{prompt} {'|'.join(choices)}")
        return None if ends and self.nobody else self.choice

    def ask_text(self, prompt: str, proposal: str, *, ends: bool = False) -> str | None:
        self.log.append(f"text? {prompt}")
        return None if ends and self.nobody else self.text or proposal

    def read_module(self, path: str, most: int) -> Source:
        if path not in self.files:
            raise rapid_error(ERR_FILNOTFND, f"{path} is missing")
        return Source(path, self.files[path][:most].decode())

    def install_texts(self, name: str, texts: Mapping[int, str]) -> None:
        self.text_tables[name] = dict(texts)

    def text_table(self, name: str) -> int | None:
        return list(self.text_tables).index(name) + 1 if name in self.text_tables else None

    def table_text(self, table: float, index: float) -> str | None:
        return list(self.text_tables.values())[int(table) - 1].get(int(index))

    def open_file(self, path: str, mode: FileMode) -> MemoryFile:
        if mode is FileMode.READ and path not in self.files:
            raise rapid_error(ERR_FILEOPEN, f"{path} is missing")
        if mode is FileMode.WRITE:
            self.files[path] = bytearray()
        return MemoryFile(self.files.setdefault(path, bytearray()))

    def date_and_time(self) -> datetime:
        return datetime(2025, 3, 1) + timedelta(seconds=int(self.time_s))

    def copy_file(self, old: str, new: str) -> None:
        self.files[new] = self.files[old]

    def rename_file(self, old: str, new: str) -> None:
        self.files[new] = self.files.pop(old)

    def remove_file(self, path: str) -> None:
        del self.files[path]

    def make_folder(self, path: str) -> None:
        self.log.append(f"folder {path}")

    def remove_folder(self, path: str) -> None:
        self.log.append(f"no folder {path}")

    def names_in(self, path: str) -> tuple[str, ...]:
        return tuple(sorted(self.files))

    def is_folder(self, path: str) -> bool:
        return f"folder {path}" in self.log

    def file_size(self, path: str) -> int | None:
        return len(self.files[path]) if path in self.files else None

    def written_s(self, path: str) -> float | None:
        return 0.0 if path in self.files else None

    def loaded_s(self, path: str) -> float:
        return 0.0

    def bytes_in(self, path: str) -> int:
        return sum(map(len, self.files.values()))

    @property
    def in_trap(self) -> bool:
        return False

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        raise AssertionError("CONNECT is no library routine")

    def is_connected(self, interrupt: float) -> bool:
        raise AssertionError("CONNECT is no library routine")

    def order_timer(self, interrupt: float, seconds: float, *, single: bool) -> None:
        self.log.append(f"timer {interrupt:g} {seconds:g} {'once' if single else 'again'}")

    def order_signal(
        self, interrupt: float, signal: str, matches: Callable[[float], bool], *, single: bool
    ) -> None:
        values = "/".join(f"{value:g}" for value in (0.0, 1.0) if matches(value))
        self.log.append(f"on {interrupt:g} {signal} {values} {'once' if single else 'again'}")

    def order_persistent(self, interrupt: float, data: Reference[object], *, single: bool) -> None:
        self.log.append(f"on {interrupt:g} {data.value} {'once' if single else 'again'}")

    def order_logged(self, interrupt: float, wanted: Callable[[LoggedError], bool]) -> None:
        self.log.append(f"on {interrupt:g} an error")

    def log_error(self, entry: LoggedError) -> None:
        self.log.append(f"error {entry.domain:g} {entry.number:g}")

    def trap_cause(self) -> LoggedError | None:
        return None

    def delete_interrupt(self, interrupt: float) -> None:
        self.log.append(f"delete {interrupt:g}")

    def sleep_interrupt(self, interrupt: float, *, asleep: bool) -> None:
        self.log.append(f"{'sleep' if asleep else 'watch'} {interrupt:g}")

    def make_safe(self, interrupt: float) -> None:
        self.log.append(f"safe {interrupt:g}")

    def start_recording(self) -> int:
        self.log.append("record")
        return 1

    def stop_recording(self, *, clear: bool) -> None:
        self.log.append(f"record no more, clear {clear}")

    def can_move_backward(self, identifier: int | None) -> bool:
        return identifier is not None

    def can_move_forward(self, identifier: int | None) -> bool:
        return identifier is not None

    def move_backward(self, identifier: int | None, *_: Pos | SpeedData | None) -> None:
        self.log.append(f"back to {identifier}")

    def move_forward(self, identifier: int | None, *_: Pos | SpeedData | None) -> None:
        self.log.append(f"forth to {identifier}")

    def hold_interrupts(self, *, hold: bool) -> None:
        self.log.append("hold" if hold else "serve")

    def read_signal(self, name: str) -> float:
        return self.signals.get(name.lower(), 0.0)

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        self.log.append(f"{name} := {value:g}{f' after {delay_s:g}' if delay_s else ''}")
        if not delay_s:
            self.signals[name.lower()] = value

    def require_within(self, name: str, value: float) -> None: ...

    def wait_for_signal(
        self, name: str, condition: Callable[[float], bool], *, max_time: float | None = None
    ) -> bool:
        self.log.append(f"wait for {name}, max {max_time}")
        return condition(self.read_signal(name))

    def book_error_number(self) -> float:
        self.booked += 1.0
        return self.booked

    task_name = "T_ROB1"
    robot_task = "T_ROB1"
    task_number = 1
    robot_number = 1
    team: tuple[str, ...] = ()
    is_missing = staticmethod(lambda name: False)

    def has_task(self, name: str) -> bool:
        return name.lower() == "t_rob1"

    def meet(
        self,
        instruction: str,
        name: str,
        tasks: Sequence[str],
        *,
        max_time: float | None = None,
        in_position: bool = False,
    ) -> bool:
        return True

    def sync_move_on(
        self, name: str, tasks: Sequence[str], *, max_time: float | None = None
    ) -> bool:
        return True

    def sync_move_off(self, name: str, *, max_time: float | None = None) -> bool:
        return True

    def leave_team(self) -> None: ...

    def suspend_team(self) -> None: ...

    def resume_team(self) -> None: ...

    def stop_robots(self, *, every: bool, quick: bool) -> None: ...

    def start_robots(self, *, every: bool) -> None: ...

    def is_robot_held(self) -> tuple[bool, bool]:
        return self.is_stopped(), False

    def frames_of(self, task: str) -> tuple[ToolData, WobjData]:
        return TOOL0, WOBJ0

    def joints_of(self, task: str) -> JointTarget:
        return self.current_joints()

    def target_of(self, task: str, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        return self.current_target(tool, wobj)

    def not_simulated(self, routine: str, treated_as: str, *, is_unknown: bool = False) -> None:
        self.unsimulated.append((routine, treated_as))
