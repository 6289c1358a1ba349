r"""Waiting, clocks, date and time, all of them virtual.

A run has no wall clock: it begins at a specified date and time, by default at midnight of
2000-01-01.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypedDict, Unpack

from rapidsim.language.annotations import (
    Bool,
    Clock,
    Deferred,
    IconData,
    Num,
    Pers,
    SignalDo,
    String,
    Switch,
    Var,
)
from rapidsim.language.controller import ClockService, Controller, Signals
from rapidsim.language.data import ClockState
from rapidsim.language.error_numbers import ERR_ARGVALERR, ERR_WAIT_MAXTIME, rapid_error
from rapidsim.language.reference import Reference
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

DEFAULT_POLL_S = 0.1
LEAST_POLL_S = 0.04
"""Minimum polling interval [s] of WaitUntil."""
WINDOW_AFTER_S = 5.0
"""Time [s] after which the window of a wait is shown, by default."""
CLOCK_RESOLUTION_S = 0.001
FINE_CLOCK_RESOLUTION_S = 0.000001
"""Resolution [s] of ClkRead; the finer one with \\HighRes."""


class Window(TypedDict, total=False):
    """The window that a wait shows on the FlexPendant."""

    visualize: Switch
    header: String
    message: String
    msg_array: list[String]
    wrap: Switch
    icon: IconData
    image: String
    visualize_time: Num
    ui_active_signal: Var[SignalDo]


def waited(
    controller: Controller,
    name: str,
    window: Window,
    wait: Callable[[float | None], bool],
    max_time: float | None,
) -> bool:
    """Wait, show a window if it takes long, and return whether the wait ended in time.

    Args:
        controller: Controller of the task.
        name: The instruction.
        window: The window to show.
        wait: Waits for at most this time [s], None without a limit.
        max_time: The limit [s], None without one.
    """
    note_ignored_options(
        controller.fidelity, name, {r"\UIActiveSignal": window.get("ui_active_signal")}
    )
    shown_s = window.get("visualize_time", WINDOW_AFTER_S)
    if not window.get("visualize") or (max_time is not None and max_time <= shown_s):
        return wait(max_time)
    if wait(shown_s):
        return True
    lines = (window.get("header"), window.get("message"), *(window.get("msg_array") or ()))
    controller.operator.show(" / ".join(line for line in lines if line))
    return wait(None if max_time is None else max_time - shown_s)


def wait_time(controller: ClockService, time: Num, *, in_pos: Switch = False) -> None:
    r"""Wait for a time [s]; with \InPos, first until the robot is at rest."""
    if time < 0.0:
        raise rapid_error(ERR_ARGVALERR, f"a wait of {time:g} s lies in the past")
    controller.wait(time, in_position=in_pos)


def wait_until(
    controller: Controller,
    cond: Deferred[Bool],
    *,
    in_pos: Switch = False,
    max_time: Num | None = None,
    time_flag: Var[Bool] | None = None,
    poll_rate: Num | None = None,
    **window: Unpack[Window],
) -> None:
    """Wait until a condition holds, by polling it."""
    if in_pos:
        controller.clock.wait(0.0, in_position=True)
    poll_s = DEFAULT_POLL_S if poll_rate is None else max(poll_rate, LEAST_POLL_S)

    def wait(limit_s: float | None) -> bool:
        return controller.signals.wait_until(cond, max_time=limit_s, poll_s=poll_s)

    in_time = waited(controller, "WaitUntil", window, wait, max_time)
    report_timeout(in_time, time_flag, "WaitUntil", max_time)


def report_timeout(
    in_time: bool, time_flag: Reference[bool] | None, name: str, max_time: float | None
) -> None:
    r"""Report the result of a wait to the program: in \TimeFlag if it has one, else as an error.

    Raises:
        RapidError: ERR_WAIT_MAXTIME, if the time ran out and there is no flag.
    """
    if time_flag is not None:
        time_flag.value = not in_time
    elif not in_time:
        raise rapid_error(ERR_WAIT_MAXTIME, f"{name} waited {max_time or 0.0:g} s in vain")


def wait_rob(
    controller: ClockService, *, in_pos: Switch = False, zero_speed: Switch = False
) -> None:
    """Wait until the robot is at its stop point, or just at rest."""
    if not (in_pos or zero_speed):
        raise rapid_error(ERR_ARGVALERR, r"WaitRob needs \InPos or \ZeroSpeed")
    controller.wait(0.0, in_position=True)


def wait_test_and_set(controller: Signals, object_: Pers[Bool]) -> None:
    """Wait until a flag is FALSE and set it."""
    controller.wait_until(lambda: not object_.value)
    object_.value = True


def clk_reset(clock: Var[Clock]) -> None:
    """Stop a clock and set it to 0."""
    clock.value = ClockState()


def clk_start(controller: ClockService, clock: Var[Clock]) -> None:
    """Start a clock; one that is running keeps running."""
    state = clock.value
    if state.started_s is None:
        clock.value = ClockState(state.counted_s, controller.now())


def clk_stop(controller: ClockService, clock: Var[Clock]) -> None:
    """Stop a clock."""
    clock.value = ClockState(_clock_time(controller, clock.value))


def clk_read(controller: ClockService, clock: Var[Clock], *, high_res: Switch = False) -> Num:
    """The reading [s] of a clock."""
    resolution = FINE_CLOCK_RESOLUTION_S if high_res else CLOCK_RESOLUTION_S
    state = clock.value
    # Half a digit of num above the last step, so that WaitTime 1.234 still reads 1.234.
    above = (1.0 + 6e-8) / resolution
    steps = math.floor(_clock_time(controller, state) * above + 1e-6)
    if state.started_s is not None:
        next_step_s = (steps + 1 - 1e-6) / above
        controller.hold_until(state.started_s + next_step_s - state.counted_s)
    return steps * resolution


def c_date(controller: ClockService) -> String:
    """The date, as `2000-01-01`."""
    return f"{controller.date_and_time():%Y-%m-%d}"


def c_time(controller: ClockService) -> String:
    """The time of day, as `06:30:00`."""
    return f"{controller.date_and_time():%H:%M:%S}"


def get_time(
    controller: ClockService,
    *,
    w_day: Switch = False,
    hour: Switch = False,
    min_: Switch = False,
    sec: Switch = False,
) -> Num:
    """One part of the date and time; days of the week count from Monday, 1."""
    if not (w_day or hour or min_ or sec):
        raise rapid_error(ERR_ARGVALERR, r"GetTime needs one of \WDay, \Hour, \Min and \Sec")
    now = controller.date_and_time()
    return float(
        now.isoweekday() if w_day else now.hour if hour else now.minute if min_ else now.second
    )


def _clock_time(controller: ClockService, state: ClockState) -> float:
    if state.started_s is None:
        return state.counted_s
    return state.counted_s + controller.now() - state.started_s


TIMING = table(
    routine("WaitTime", wait_time, r"\InPos Time", does=Trait.WAIT),
    routine(
        "WaitUntil",
        wait_until,
        r"\InPos Cond \MaxTime \TimeFlag \PollRate \Visualize \Header \Message|\MsgArray \Wrap "
        r"\Icon \Image \VisualizeTime \UIActiveSignal",
    ),
    routine("WaitRob", wait_rob, r"\InPos|\ZeroSpeed", does=Trait.WAIT),
    routine("WaitTestAndSet", wait_test_and_set, "Object", does=Trait.WAIT),
    routine("ClkReset", clk_reset, does=Trait.INSTANT),
    routine("ClkStart", clk_start, does=Trait.INSTANT),
    routine("ClkStop", clk_stop, does=Trait.INSTANT),
    routine("ClkRead", clk_read, does=Trait.READ_TASK | Trait.TIME),
    routine("CDate", c_date, does=Trait.TIME),
    routine("CTime", c_time, does=Trait.TIME),
    routine("GetTime", get_time, r"\WDay|\Hour|\Min|\Sec", does=Trait.TIME),
)
