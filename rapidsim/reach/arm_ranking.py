"""Ranking of the arms of the catalogue for the targets of programs: reach and configurations.

ABB arms with a closed form are tried. An arm without a closed form is tried at a few targets, as
each needs a search, and only if a text names it or the targets have seven axes: then only arms with
seven axes are ranked. Seven axes are recognised by `eax_a` in every target, an angle that no track
of the station explains, together with a `cfx` above 7, with a name such as T_ROB_L, or with an arm
that reaches all targets if no other arm makes them as stored.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from statistics import median

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import JointTarget, RobTarget
from rapidsim.motion.configurations import targets
from rapidsim.motion.configurations.confdata import has_branches
from rapidsim.motion.configurations.reachability import programmed_excess
from rapidsim.motion.robot.catalogue import find_entry, robot_names
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.reach.arm_configurations import confdata_columns, solved_ends
from rapidsim.reach.dataflow.known_moves import KnownMoves
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.reach.target_poses import posed
from rapidsim.values import value_class

MAKER = "ABB"
_MOST_TARGETS = 400
_MOST_SEARCHED = 10
_USUAL_AXES = 6
_SEVEN_AXES = 7
_NEARLY_ALL = 0.9
_LARGEST_CFX = 7.0
"""Largest cfx of arms with six axes."""
_HALF_TURN_DEG = 180.0
_TWO_ARMED = "14000"
_SEVEN_AXIS_TYPES = (_TWO_ARMED, "14050")
_SIDE = re.compile(r"(?<![a-z])(?:rob|yumi)[_-](l|r|left|right)(?![a-z])", re.IGNORECASE)
_HINT = re.compile(
    r"(?<![a-z])(?P<kind>irb|crb|rob\d_(?:[lr]_)?(?:irb_|crb_)?)[ _-]?(?P<model>\d{3,5})"
    r"(?P<figures>(?:[ _/-]+\d+(?:\.\d+)?(?:kg|m)?){0,2})",
    re.IGNORECASE,
)
_FIGURE = re.compile(r"\d+(?:\.\d+)?")
_CALLED = {"yumi": "14000", "gofa": "15000"}
_PARTS = re.compile(r"[a-z]+(\d+)\w*-([\d.]+)-([\d.]+)(?:-(\w+))?")
_OTHER_MODEL = 10.0
_LONGEST_TEXT = 200_000


@value_class(frozen=True, slots=True, eq=False)
class ProgramTargets:
    """Distinct targets that programs use."""

    base_from_flange: Transform
    """Poses (k,)."""
    confdata: Array
    """Stored configurations (k, 4)."""
    axes: tuple[JointTarget, ...]
    heaviest_kg: float
    """Largest mass of a tool with its load."""
    arm_angles: tuple[float, ...] = ()
    """Values [deg] of `eax_a`, which may be a seventh axis; empty if a target has none."""
    largest_cfx: float = 0.0

    @property
    def count(self) -> int:
        """Number of targets."""
        return len(self.confdata) + len(self.axes)


@value_class(frozen=True, slots=True)
class Hint:
    """An arm that a text names: number of its type, and figures such as reach or payload."""

    model: str
    figures: tuple[float, ...] = ()
    family: str | None = None
    """`irb` or `crb`; None if not named."""
    side: str | None = None
    """First letter of the arm of a two-armed robot; None if not named."""

    def deviation(self, name: str) -> float:
        """Return the distance of an arm of the catalogue from the hint; 0 if they agree."""
        parts = _PARTS.fullmatch(name)
        if parts is None:
            return 2.0 * _OTHER_MODEL
        known = (float(parts[2]), float(parts[3]))
        apart = sum(min(abs(one - x) / max(one, x) for x in known) for one in self.figures)
        apart += self.family is not None and not name.startswith(self.family)
        apart += self.side is not None and not (parts[4] or "").startswith(self.side)
        return apart if parts[1] == self.model else _OTHER_MODEL + apart


@value_class(frozen=True, slots=True)
class RankedArm:
    """An arm, and the numbers of targets that it makes."""

    name: str
    reach_m: float | None
    tried: int
    """Number of targets that were tried."""
    reached: int
    satisfied: int
    """Number of targets reached in the stored configuration."""
    carries: bool
    """Whether the arm is rated for the heaviest tool."""
    has_six_axes: bool
    has_own_speeds: bool
    """Whether a source states the speeds of its axes; else those of another arm are used."""
    is_named: bool
    """Whether a text names its type."""
    deviation: float
    """Deviation from the arms that texts name; 0 if no arm is named."""
    name_counts: bool = False
    """Whether its name counts more than its reach, as no arm reaches nearly all targets: then the
    place of the robot is unknown."""

    @property
    def score(self) -> tuple[bool, float, bool, float, bool]:
        """Larger is better; equal for arms that suit the targets equally well."""
        tried = max(self.tried, 1)
        # Configurations of other kinds of arms have another meaning, and a palletizer with its four
        # axes holds all zeros.
        usual = self.has_six_axes or self.is_named
        leads = self.is_named and (self.name_counts or self.reached == self.tried)
        return leads, self.reached / tried, usual, self.satisfied / tried, self.carries

    @property
    def makes_all(self) -> bool:
        """Whether it makes all targets as they are stored."""
        return self.tried == self.reached == self.satisfied and self.carries


def program_targets(
    programs: Iterable[Program], base_from_world: Transform, *, has_axis_a: bool = False
) -> ProgramTargets:
    """Return the statically known targets, each once; an even selection if there are many.

    Args:
        programs: The programs.
        base_from_world: The inverse of the base frame.
        has_axis_a: Whether the station has an external axis `a`, so that `eax_a` is its value.

    Raises:
        RunNotFollowedError: See `walk_program`.
    """
    distinct: dict[bytes, tuple[KnownMoves, int]] = {}
    frames: dict[object, int] = {}
    axes: dict[JointTarget, None] = {}
    heaviest = 0.0
    for program in programs:
        moves = walk_program(program).moves
        for known in moves.of_tree:
            heaviest = max(heaviest, float(known.move.tool.tload.mass))
            if isinstance(known.move.to, JointTarget):
                axes[known.move.to] = None
        frame = moves.each(
            lambda known: frames.setdefault((known.move.tool, known.move.wobj), len(frames)), int
        )
        rows = np.flatnonzero(moves.each(lambda known: isinstance(known.move.to, RobTarget)))
        # 0.0 and -0.0 are the same number, but not the same bytes.
        table = np.column_stack([moves.numbers(rows) + 0.0, frame[rows]])
        for row, written in zip(rows.tolist(), table, strict=True):
            distinct.setdefault(written.tobytes(), (moves, row))
    found = list(distinct.values())
    chosen = [found[at][0][found[at][1]] for at in _chosen(len(found), _MOST_TARGETS)]
    # Poses do not depend on the arm.
    listed = KnownMoves.listed(chosen)
    placed = posed(listed, load_robot(robot_names()[0]), base_from_world)
    rows = np.flatnonzero(placed.is_placed)
    ends = [*(known.move.to for known in chosen), *axes]
    return ProgramTargets(
        placed.base_from_flange[rows],
        confdata_columns(listed, rows),
        tuple(list(axes)[row] for row in _chosen(len(axes), _MOST_TARGETS)),
        heaviest,
        () if has_axis_a else _arm_angles(ends),
        max((to.robconf.cfx for to in ends if isinstance(to, RobTarget)), default=0.0),
    )


def _arm_angles(reached: Sequence[RobTarget | JointTarget]) -> tuple[float, ...]:
    """Return the values of `eax_a` of targets; empty unless all have one that may be an angle."""
    values = tuple(target.extax.eax_a for target in reached)
    return values if all(abs(value) <= _HALF_TURN_DEG for value in values) else ()


def _chosen(count: int, most: int) -> list[int]:
    """Return evenly spaced rows; all if there are few."""
    if count <= most:
        return list(range(count))
    return [round(n * (count - 1) / (most - 1)) for n in range(most)]


def hints_of(texts: Iterable[str], names: Sequence[str] = ()) -> tuple[Hint, ...]:
    """Return the arms that texts name.

    Args:
        texts: Texts such as comments of a program or a type in a backup.
        names: Names of files, folders, tasks and stations. Only these name an arm of a two-armed
            robot: programs of one of its arms also mention the other.
    """
    hints: dict[Hint, None] = {}
    for text in (*names, *texts):
        for match in _HINT.finditer(text[:_LONGEST_TEXT]):
            figures = tuple(float(one) for one in _FIGURE.findall(match["figures"]))
            family = "crb" if "crb" in match["kind"].lower() else "irb"
            hints[Hint(match["model"], tuple(x for x in figures if x > 0.0), family)] = None
        folded = text[:_LONGEST_TEXT].lower()
        for word, model in _CALLED.items():
            if re.search(rf"(?<![a-z]){word}(?![a-z])", folded):
                hints[Hint(model)] = None
    sides = {match[1][0].lower() for name in names for match in _SIDE.finditer(name)}
    if len(sides) == 1:
        side = Hint(_TWO_ARMED, side=sides.pop())
        return (side, *(hint for hint in hints if hint.model != _TWO_ARMED))
    return tuple(hints)


def rank_arms(
    of_programs: ProgramTargets, hints: Sequence[Hint], preferred: str
) -> tuple[RankedArm, ...]:
    """Return the arms, best first.

    An arm that a text names comes first if it reaches all targets, or if no arm reaches nearly all.
    A tie is won by the arm nearest to one that a text names, then by the preferred one, then by the
    one whose reach is in the middle: with the shortest, lines between the targets may leave it.

    Args:
        of_programs: Targets to reach.
        hints: The arms that texts name.
        preferred: Name of an arm.
    """
    ranked = [
        ranked_arm(robot, of_programs, deviation, is_named=is_named)
        for robot, deviation, is_named in _candidates(hints)
        if has_branches(robot.kinematics) or is_named
    ]
    ranked = _seven_axis_arms(of_programs, hints, ranked) or ranked

    reached = max(arm.reached / max(arm.tried, 1) for arm in ranked)
    if reached < _NEARLY_ALL:
        ranked = [replace(arm, name_counts=True) for arm in ranked]
    best = max(ranked, key=lambda arm: (*arm.score, -arm.deviation, arm.has_own_speeds))
    ties = [arm for arm in ranked if arm.score == best.score and arm.deviation == best.deviation]
    middle = median(arm.reach_m or 0.0 for arm in ties)

    def order(arm: RankedArm) -> tuple[float, ...]:
        worse = (-float(part) for part in arm.score)
        apart = abs((arm.reach_m or 0.0) - middle)
        return (*worse, arm.deviation, arm.name != preferred, not arm.has_own_speeds, apart)

    # Sorting is stable, and the names of the catalogue have an order.
    return tuple(sorted(ranked, key=order))


def _candidates(hints: Sequence[Hint]) -> Iterator[tuple[Robot, float, bool]]:
    """Yield the arms of the maker, with deviation from the hints and whether a hint names it."""
    for name in robot_names():
        if find_entry(name).maker == MAKER:
            deviation = min((hint.deviation(name) for hint in hints), default=0.0)
            yield load_robot(name), deviation, bool(hints) and deviation < _OTHER_MODEL


def _seven_axis_arms(
    of_programs: ProgramTargets, hints: Sequence[Hint], others: Sequence[RankedArm]
) -> list[RankedArm]:
    """Arms with seven axes; empty if the targets are for one of the others, on a track."""
    if not of_programs.arm_angles:
        return []
    is_named = any(hint.model in _SEVEN_AXIS_TYPES for hint in hints)
    is_sure = is_named or of_programs.largest_cfx > _LARGEST_CFX
    if not is_sure and (not any(of_programs.arm_angles) or any(arm.makes_all for arm in others)):
        return []
    ranked = [
        ranked_arm(robot, of_programs, deviation, is_named=is_named)
        for robot, deviation, is_named in _candidates(hints)
        if len(robot.joints) == _SEVEN_AXES
    ]
    return ranked if is_sure or any(arm.reached == arm.tried for arm in ranked) else []


def ranked_arm(
    robot: Robot, of_programs: ProgramTargets, deviation: float = 0.0, *, is_named: bool = False
) -> RankedArm:
    """Return an arm with the numbers of targets that it makes."""
    most = _MOST_TARGETS if has_branches(robot.kinematics) else _MOST_SEARCHED
    rows = _chosen(len(of_programs.confdata), most)
    reached = held = 0
    if rows:
        poses = Transform(
            of_programs.base_from_flange.rotation[rows],
            of_programs.base_from_flange.translation[rows],
        )
        solved = solved_ends(robot, poses, of_programs.confdata[rows])
        reached = int(solved.reachable.sum())
        stored = solved.stored_works if has_branches(robot.kinematics) else solved.reachable
        held = int((solved.reachable & stored).sum())
    within = sum(
        not programmed_excess(robot, targets.joints(one, robot.kinematics)).any()
        for one in of_programs.axes
    )
    payload = robot.payload_kg
    return RankedArm(
        robot.name,
        robot.reach_m,
        len(rows) + len(of_programs.axes),
        reached + within,
        held + within,
        payload is None or of_programs.heaviest_kg <= payload,
        len(robot.joints) == _USUAL_AXES,
        robot.axis_speeds_from is None,
        is_named,
        deviation,
    )
