"""Which arms of the catalogue suit the targets of programs: reach and stored configurations.

Arms of ABB with a closed form are tried; one without, only where a text names it, and at a few
targets: each takes a search.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from statistics import median

from rapidsim.analysis.program import Program
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import JointTarget
from rapidsim.motion.configurations import targets
from rapidsim.motion.configurations.confdata import told_apart
from rapidsim.motion.configurations.reachability import programmed_excess
from rapidsim.motion.robot.catalogue import find_entry, robot_names
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.reach.arm_configurations import confdata_columns, solved_ends
from rapidsim.reach.dataflow.known_moves import KnownMove
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.reach.target_poses import posed
from rapidsim.values import dataclass

MAKER = "ABB"
_MOST_TARGETS = 400
_MOST_SEARCHED = 10
_USUAL_AXES = 6
_HINT = re.compile(
    r"(?<![a-z])(?:irb|crb|rob\d_(?:[lr]_)?(?:irb_|crb_)?)[ _-]?(\d{3,5})"
    r"((?:[ _/-]+\d+(?:\.\d+)?(?:kg|m)?){0,2})",
    re.IGNORECASE,
)
_FIGURE = re.compile(r"\d+(?:\.\d+)?")
_CALLED = {"yumi": "14000", "gofa": "15000", "rob_[lr]": "14000"}
"""Type numbers by a pattern of what names them; ROB_L and ROB_R are the arms of the IRB 14000."""
_PARTS = re.compile(r"[a-z]+(\d+)\w*-([\d.]+)-([\d.]+)")
_OTHER_MODEL = 10.0
_LONGEST_TEXT = 200_000


@dataclass(frozen=True, slots=True, eq=False)
class ProgramTargets:
    """The distinct targets that programs name."""

    base_from_flange: Transform
    """Poses (k,)."""
    confdata: Array
    """Stored configurations (k, 4)."""
    axes: tuple[JointTarget, ...]
    heaviest_kg: float
    """The heaviest tool with what it holds."""

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.confdata) + len(self.axes)


@dataclass(frozen=True, slots=True)
class Hint:
    """An arm that a text names: the number of its type, and figures such as reach or payload."""

    model: str
    figures: tuple[float, ...] = ()

    def deviation(self, name: str) -> float:
        """How far an arm of the catalogue is from it; 0 for the same."""
        parts = _PARTS.fullmatch(name)
        if parts is None:
            return 2.0 * _OTHER_MODEL
        known = (float(parts[2]), float(parts[3]))
        apart = sum(min(abs(one - x) / max(one, x) for x in known) for one in self.figures)
        return apart if parts[1] == self.model else _OTHER_MODEL + apart


@dataclass(frozen=True, slots=True)
class RankedArm:
    """An arm, and how many of the targets it makes."""

    name: str
    reach_m: float | None
    tried: int
    """How many targets were tried."""
    reached: int
    held: int
    """Those that it reaches in the stored configuration."""
    carries: bool
    """Whether it is rated for the heaviest tool."""
    has_six_axes: bool
    has_speeds: bool
    """Whether the speeds of its axes are known, which a run needs."""
    is_named: bool
    """Whether a text names its type."""
    deviation: float
    """From the arms that texts name; 0 where none is named."""

    @property
    def score(self) -> tuple[float, bool, float, bool]:
        """Larger is better; equal for arms that suit the targets equally well."""
        tried = max(self.tried, 1)
        # Configurations of other kinds of arms mean something else, and a palletizer with its four
        # axes holds all zeros.
        usual = self.has_six_axes or self.is_named
        return self.reached / tried, usual, self.held / tried, self.carries

    @property
    def makes_all(self) -> bool:
        """Whether it makes all targets as they are stored."""
        return self.tried == self.reached == self.held and self.carries


def program_targets(programs: Iterable[Program], base_from_world: Transform) -> ProgramTargets:
    """The targets that are known without a run, each once; evenly chosen ones of very many.

    Raises:
        RunNotFollowedError: See `walk_program`.
    """
    distinct: dict[object, KnownMove] = {}
    axes: dict[JointTarget, None] = {}
    heaviest = 0.0
    for program in programs:
        for known in walk_program(program).known:
            move = known.move
            heaviest = max(heaviest, float(move.tool.tload.mass))
            if isinstance(move.to, JointTarget):
                axes[move.to] = None
            else:
                distinct.setdefault((move.to, move.tool, move.wobj), known)
    moves = list(distinct.values())
    chosen = [moves[row] for row in _chosen(len(moves), _MOST_TARGETS)]
    # Poses do not depend on the arm.
    placed = posed(chosen, load_robot(robot_names()[0]), base_from_world)
    rows = [row for row in range(len(chosen)) if row not in placed.left_out]
    return ProgramTargets(
        Transform(
            placed.base_from_flange.rotation[rows], placed.base_from_flange.translation[rows]
        ),
        confdata_columns([chosen[row] for row in rows]),
        tuple(list(axes)[row] for row in _chosen(len(axes), _MOST_TARGETS)),
        heaviest,
    )


def _chosen(count: int, most: int) -> list[int]:
    """Evenly chosen rows, all where there are few."""
    if count <= most:
        return list(range(count))
    return [round(n * (count - 1) / (most - 1)) for n in range(most)]


def hints_of(texts: Iterable[str]) -> tuple[Hint, ...]:
    """The arms that texts name, such as comments of a program or a type in a backup."""
    hints: dict[Hint, None] = {}
    for text in texts:
        for match in _HINT.finditer(text[:_LONGEST_TEXT]):
            figures = tuple(float(one) for one in _FIGURE.findall(match[2]))
            hints[Hint(match[1], tuple(x for x in figures if x > 0.0))] = None
        folded = text[:_LONGEST_TEXT].lower()
        for word, model in _CALLED.items():
            if re.search(rf"(?<![a-z]){word}(?![a-z])", folded):
                hints[Hint(model)] = None
    return tuple(hints)


def rank_arms(
    of_programs: ProgramTargets, hints: Sequence[Hint], preferred: str
) -> tuple[RankedArm, ...]:
    """The arms, best first.

    A tie goes to the arm nearest to one that a text names, then to the preferred one, then to the
    one whose reach is in the middle: with the shortest, lines between the targets may leave it.

    Args:
        of_programs: What they have to reach.
        hints: The arms that texts name.
        preferred: The name of an arm.
    """
    ranked = []
    for name in robot_names():
        if find_entry(name).maker != MAKER:
            continue
        deviation = min((hint.deviation(name) for hint in hints), default=0.0)
        robot = load_robot(name)
        is_named = bool(hints) and deviation < _OTHER_MODEL
        if told_apart(robot.kinematics) or is_named:
            ranked.append(ranked_arm(robot, of_programs, deviation, is_named=is_named))

    best = max(ranked, key=lambda arm: (*arm.score, -arm.deviation, arm.has_speeds))
    ties = [arm for arm in ranked if arm.score == best.score and arm.deviation == best.deviation]
    middle = median(arm.reach_m or 0.0 for arm in ties)

    def order(arm: RankedArm) -> tuple[float, ...]:
        worse = (-float(part) for part in arm.score)
        apart = abs((arm.reach_m or 0.0) - middle)
        return (*worse, arm.deviation, arm.name != preferred, not arm.has_speeds, apart)

    # Sorting is stable, and the names of the catalogue have an order.
    return tuple(sorted(ranked, key=order))


def ranked_arm(
    robot: Robot, of_programs: ProgramTargets, deviation: float = 0.0, *, is_named: bool = False
) -> RankedArm:
    """What an arm makes of targets."""
    most = _MOST_TARGETS if told_apart(robot.kinematics) else _MOST_SEARCHED
    rows = _chosen(len(of_programs.confdata), most)
    reached = held = 0
    if rows:
        poses = Transform(
            of_programs.base_from_flange.rotation[rows],
            of_programs.base_from_flange.translation[rows],
        )
        solved = solved_ends(robot, poses, of_programs.confdata[rows])
        reached = int(solved.reachable.sum())
        stored = solved.stored_works if told_apart(robot.kinematics) else solved.reachable
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
        all(joint.max_speed is not None for joint in robot.joints),
        is_named,
        deviation,
    )
