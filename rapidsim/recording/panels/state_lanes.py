"""States over time as coloured lanes: the active move, and each signal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice

import numpy as np
import rerun as rr

from rapidsim.controller.journal.events import ErrorTally
from rapidsim.controller.moves.executed_moves import ExecutedMoves, MoveColumns
from rapidsim.language.error_answers import ErrorOutcome, shown_name
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.scene.targets import target_name
from rapidsim.recording.stream import ROWS_AT_ONCE
from rapidsim.recording.timelines import Clock
from rapidsim.simulation.results.active_limits import active_limits
from rapidsim.simulation.results.signal_history import signal_changes

MOVE_LANE = "moves"
SIGNALS = "signals"
CLEARANCE_LANE = "clearance"
LIMIT_LANE = "limits"
ERRORS = "errors"

_MOST_STATES = 200
"""Number of different moves above which a lane contains only instruction names."""
_STANDSTILL = "at rest"
_CLEAR = "clear"
_NO_ERROR = "no error"
_SHORTEST_STANDSTILL_S = 1e-6

_States = list[tuple[float, str]]


def log_moves(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log the moves of a robot."""
    if run.robot_run.moves:
        states, colours = _move_states(run.robot_run.moves)
        _log_lane(stream, run.entity(MOVE_LANE), states, colours, run.clock)


def log_limits(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log the active limit of a robot's motion."""
    if not run.robot_run.moves:
        return
    active = active_limits(run.sampled.simulation, run.robot_run)
    times = run.samples.times
    numbers = active.at(times)
    numbers = np.where(np.abs(run.sampled.joint_speed).max(axis=1) > 0.0, numbers, -1)
    changes = np.flatnonzero(np.diff(numbers, prepend=-2))
    states: _States = []
    colours: dict[str, palette.Colour] = {_STANDSTILL: palette.STANDSTILL}
    for time_s, number in zip(times[changes].tolist(), numbers[changes].tolist(), strict=True):
        limit = active.limits[number] if number > 0 else None
        state = limit.text if limit is not None else _STANDSTILL
        if limit is not None:
            colours.setdefault(state, palette.of_limit(limit.quantity, limit.axis))
        states.append((time_s, state))
    _log_lane(stream, run.entity(LIMIT_LANE), states, colours, run.clock)


def log_signals(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log the signals of the whole cell."""
    for name, changes in signal_changes(run.sampled.simulation).items():
        states, colours = _signal_states(changes)
        _log_lane(stream, rr.new_entity_path([SIGNALS, name]), states, colours, run.clock)


def log_errors(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log the latest error of each task: one lane per task with an error."""
    by_task: dict[str, list[ErrorTally]] = {}
    for tally in run.sampled.simulation.errors:
        by_task.setdefault(tally.task, []).append(tally)
    for task, tallies in by_task.items():
        states: _States = [(0.0, _NO_ERROR)]
        colours = {_NO_ERROR: palette.STANDSTILL}
        # For repeated errors, the first and the last occurrence.
        times = sorted(
            (time_s, number)
            for number, tally in enumerate(tallies)
            for time_s in dict.fromkeys((tally.time_s, tally.last_s))
        )
        for time_s, number in times:
            tally = tallies[number]
            lost = tally.error.outcome in (ErrorOutcome.FELL_THROUGH, ErrorOutcome.ENDED)
            state = f"{shown_name(tally.error)} {tally.error.outcome}"
            if len(colours) <= _MOST_STATES or state in colours:
                colours[state] = palette.FAILED if lost else palette.WARNED
                states.append((time_s, state))
        _log_lane(stream, rr.new_entity_path([ERRORS, task]), states, colours, run.clock)


def log_clearance(stream: rr.RecordingStream, runs: Sequence[RecordedRobot]) -> None:
    """Log the clearance of bodies in each move: one lane per robot."""
    collisions = runs[0].sampled.simulation.collisions
    if collisions is None:
        return
    for number, run in enumerate(runs):
        touched = {one.move for one in collisions.report.contacts if one.robot == number}
        near = {
            one.move: one.distance_m for one in collisions.report.clearances if one.robot == number
        }
        states: _States = [(0.0, _CLEAR)]
        colours = {_CLEAR: palette.STANDSTILL}
        for move in run.robot_run.moves:
            distance_m = near.get(move.index)
            if move.index in touched:
                state, colour = "contact", palette.FAILED
            elif distance_m is None:
                state, colour = _CLEAR, palette.STANDSTILL
            else:
                low = distance_m < collisions.geometry.clearance_m
                state = f"{1000.0 * distance_m:.0f} mm"
                colour = palette.WARNED if low else palette.SIGNAL_ON
            if len(colours) <= _MOST_STATES or state in colours:
                colours[state] = colour
                states.append((move.start_s, state))
        _log_lane(stream, run.entity(CLEARANCE_LANE), states, colours, run.clock)


def _log_lane(
    stream: rr.RecordingStream,
    entity: str,
    states: Iterable[tuple[float, str]],
    colours: Mapping[str, palette.Colour],
    clock: Clock,
) -> None:
    stream.log(
        entity,
        rr.StateConfiguration(
            values=list(colours),
            labels=list(colours),
            colors=np.array([palette.rgba(colour) for colour in colours.values()], dtype=np.uint32),
        ),
        static=True,
    )
    remaining = iter(states)
    while block := list(islice(remaining, ROWS_AT_ONCE)):
        stream.send_columns(
            entity,
            indexes=clock.columns([time_s for time_s, _ in block]),
            columns=rr.StateChange.columns(state=[state for _, state in block]),
        )


def _move_states(
    moves: ExecutedMoves,
) -> tuple[Iterable[tuple[float, str]], dict[str, palette.Colour]]:
    """Return the move lane: moves, and rest in between."""
    columns = moves.columns
    programmed = columns.templates
    names, distinct = [], set[str]()
    for move, place in zip(programmed, columns.places, strict=True):
        names.append(f"{move.instruction} {target_name(place)}".rstrip())
        distinct.add(names[-1])
        if len(distinct) > _MOST_STATES:
            names = [move.instruction for move in programmed]
            break
    colours: dict[str, palette.Colour] = {_STANDSTILL: palette.STANDSTILL}
    for name, move in zip(names, programmed, strict=True):
        if name not in colours:
            # Every other move is a shade darker: neighbours of one kind would merge.
            colour = palette.of_move(move)
            colours[name] = colour if len(colours) % 2 else palette.darker(colour)
    return _with_rests(names, columns), colours


def _with_rests(names: Sequence[str], moves: MoveColumns) -> Iterator[tuple[float, str]]:
    """Yield the changes of the move lane: the starts of moves, and rest in between."""
    over_s = 0.0
    for begin in range(0, len(names), ROWS_AT_ONCE):
        some = slice(begin, begin + ROWS_AT_ONCE)
        start_s, end_s = moves.start_s[some], moves.end_s[some]
        makes_way = end_s > start_s
        last = np.maximum.accumulate(np.where(makes_way, np.arange(len(start_s)), -1))
        before_s = np.append(over_s, np.where(last < 0, over_s, end_s[last]))
        rests = start_s > before_s[:-1] + _SHORTEST_STANDSTILL_S
        for name, time_s, makes, rest_s, rests_before in zip(
            names[some], start_s, makes_way, before_s, rests, strict=False
        ):
            if rests_before:
                yield rest_s, _STANDSTILL
            if makes:
                yield time_s, name
        over_s = before_s[-1]
    yield over_s, _STANDSTILL


def _signal_states(
    changes: Sequence[tuple[float, float]],
) -> tuple[_States, dict[str, palette.Colour]]:
    """Return the lane of a signal: on and off if it has only these values, else numbers."""
    if all(value in (0.0, 1.0) for _, value in changes):
        states = [(time_s, "on" if value else "off") for time_s, value in changes]
        colours = {"off": palette.SIGNAL_OFF, "on": palette.SIGNAL_ON}
    else:
        states = [(time_s, f"{value:g}") for time_s, value in changes]
        distinct = dict.fromkeys(state for _, state in states)
        colours = dict.fromkeys(distinct, palette.SIGNAL_VALUE)
    return states, colours
