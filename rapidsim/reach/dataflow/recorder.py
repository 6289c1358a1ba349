"""A controller without a robot, on which single instructions are performed.

It has settings, takes moves, lets pass what changes nothing about them, and refuses whatever a run
would have to answer. mypy holds it against the protocol where `instructions.py` hands it over.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

from rapidsim.language.modules import Modules
from rapidsim.language.moves import MotionSettings, Move, Place
from rapidsim.language.path_events import Trigger
from rapidsim.language.symbols import Symbols


class NeedsRunError(Exception):
    """An instruction asked something of the controller that only a run can answer."""


def _refuse(*_given: object, **_options: object) -> NoReturn:
    raise NeedsRunError


class Recorder:
    """Stands for the controller: keeps settings, takes moves, and knows nothing of a robot."""

    # Without a value, so that they are refused too.
    place: Place
    symbols: Symbols
    modules: Modules
    path_level: float
    call_procedure: Callable[[str], None]

    def __init__(self, settings: MotionSettings) -> None:
        """Begin with the settings where the instruction stands."""
        self.settings = settings
        self.moves: list[Move] = []
        self.left = 0
        self.errno = 0.0
        self.intno = 0.0

    def move(self, move: Move, triggers: tuple[Trigger, ...] = ()) -> None:
        """Keep a move; what happens on its way changes nothing about it."""
        self.moves.append(move)

    def not_simulated(self, routine: str, treated_as: str) -> None:
        """The run that meets it says so."""

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Outputs change nothing about the moves."""

    @property
    def in_trap(self) -> bool:
        """Refused."""
        raise NeedsRunError

    @property
    def task_name(self) -> str:
        """Refused."""
        raise NeedsRunError

    @property
    def task_number(self) -> int:
        """Refused."""
        raise NeedsRunError

    @property
    def robot_number(self) -> int:
        """Refused."""
        raise NeedsRunError

    @property
    def team(self) -> tuple[str, ...]:
        """Refused."""
        raise NeedsRunError

    def __getattr__(self, name: str) -> NoReturn:
        """Refuse what has no value."""
        raise NeedsRunError(name)

    now = date_and_time = wait = wait_until = service = _refuse
    current_joints = current_target = target_at = joints_at = active_tool = active_wobj = _refuse
    stop_move = start_move = is_stopped = clear_path = store_path = restore_path = _refuse
    search = search_joints = _refuse
    watch_zone = enable_zone = free_zone = _refuse
    show = clear_screen = ask_number = ask_choice = ask_text = _refuse
    open_file = read_module = copy_file = rename_file = remove_file = _refuse
    make_folder = remove_folder = names_in = is_folder = file_size = bytes_in = _refuse
    install_texts = text_table = table_text = _refuse
    open_port = accept_client = connect_socket = send_bytes = await_bytes = close_socket = _refuse
    connect = is_connected = order_timer = order_signal = order_persistent = order_logged = _refuse
    log_error = trap_cause = delete_interrupt = sleep_interrupt = hold_interrupts = _refuse
    read_signal = wait_for_signal = book_error_number = _refuse
    has_task = meet = move_together = move_apart = leave_team = _refuse
    suspend_team = resume_team = joints_of = target_of = _refuse
    stop_other_robots = start_other_robots = _refuse
