"""The segments that a check makes of moves, and those of a run, by their places in the text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, fields, is_dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from simulation_program import arm

from rapidsim.analysis.program import Program
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.files import InputError
from rapidsim.frames.transform import Transform
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.language.moves import Move
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.model import MotionModel
from rapidsim.reach.arm_configurations import ends_of
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.reach.move_segments import segments_of
from rapidsim.reach.path_findings import PathSurvey
from rapidsim.reach.target_poses import posed
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate

MODEL = MotionModel(payload_acceleration=0.5)
OPTIONS = RunOptions(max_time_s=20.0, model=MODEL, answers=lambda prompt: None)
Key = tuple[int, Move, int, Move]
"""Where two moves in a row stand in the text, and what they are."""


def judged(program: Program) -> dict[Key, list[Segment]]:
    """The segments that a check makes of moves whose start and end it knows."""
    walked, robot, model = walk_program(program), arm(), MODEL
    placed = posed(walked.moves, robot, Transform.identity())
    ways = PathSurvey(program, placed, ends_of(placed, robot), robot, model, {}).survey()
    sure = ways.stances.sure
    previous = walked.moves.previous
    others = np.flatnonzero(
        ~ways.is_surveyed & placed.is_placed & (previous >= 0) & sure & sure[previous]
    )
    joints = ways.stances.joints
    made: dict[int, Segment] = {}
    if len(others):
        segments = segments_of(placed, joints, robot, model, others)
        made |= zip(others.tolist(), segments, strict=True)
    followed = np.flatnonzero(ways.is_surveyed & ~ways.is_broken).tolist()
    made |= {row: ways.driven(row) for row in followed}
    found: dict[Key, list[Segment]] = {}
    for row, segment in made.items():
        known = walked.moves[row]
        if known.previous is not None and not known.uncertain:
            before = walked.moves[known.previous]
            key = (known.call.start, known.move, before.call.start, before.move)
            found.setdefault(key, []).append(segment)
    return found


@dataclass(frozen=True)
class Driven:
    """A run of a program in its first seconds."""

    run: Simulation | None
    """None for a program that cannot be run."""
    segments: Mapping[Key, list[Segment]]


def driven(program: Program) -> Driven:
    """A run, and the segments that it makes."""
    made: list[tuple[QueuedMove, Segment]] = []
    resolve = Resolver.resolve
    run = None

    def recorded(*arguments: Any, **named: Any) -> QueuedMove:
        queued = resolve(*arguments, **named)
        made.append((queued, queued.segment))
        return queued

    with pytest.MonkeyPatch.context() as patch, suppress(InputError, NotExecutableError):
        patch.setattr(Resolver, "resolve", recorded)
        run = simulate(program, arm(), options=OPTIONS)
    found: dict[Key, list[Segment]] = {}
    for (before, _), (queued, segment) in pairwise(made):
        key = (queued.place.span.start, queued.move, before.place.span.start, before.move)
        found.setdefault(key, []).append(segment)
    return Driven(run, found)


def agreeing(judged: Mapping[Key, list[Segment]], run: Mapping[Key, list[Segment]]) -> int:
    """How many segments of a check were found among those of the run that made the same moves."""
    both = [(one, run[key]) for key, made in judged.items() if key in run for one in made]
    for one, others in both:
        differing = [list(differences(one, other)) for other in others]
        assert not all(differing), differing[0]
    return len(both)


def differences(a: object, b: object, name: str = "") -> Iterator[str]:
    """The fields in which two values differ by more than rounding."""
    if is_dataclass(a) and type(a) is type(b):
        for field in fields(a):
            if (type(a), field.name) != (Segment, "index"):
                inner = getattr(a, field.name), getattr(b, field.name)
                yield from differences(*inner, f"{name}.{field.name}")
    elif isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        if a.shape != b.shape or np.abs(a - b).max(initial=0.0) > 1e-9:
            yield f"{name}: {a} {b}"
    elif isinstance(a, float) and isinstance(b, float):
        if a != b and abs(a - b) > 1e-9:
            yield f"{name}: {a} {b}"
    elif a != b:
        yield f"{name}: {a} {b}"
