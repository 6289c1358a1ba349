"""Moving bodies: the pose of each at any time of a run, and the pairs to check."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import field

import numpy as np
import numpy.typing as npt

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.convex import Index
from rapidsim.collisions.shape import Shape
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.targets import world_from_base_at, world_from_unit_at
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import JointSamples
from rapidsim.values import value_class

STEP_S = 0.016
"""Sampling interval [s] of a motion with no bodies nearby."""
SHORTEST_S = 4e-5
"""Accuracy [s] of the reported start of a contact."""
Bodily = int | Index
"""Index of a body, or indices of several."""
_ALL = slice(None)


@value_class(frozen=True, slots=True)
class SceneFrame:
    """A frame that moves with a robot or a belt, or the world frame."""

    robot: int | None = None
    """Index of the robot; None for the world and for belts."""
    link: int = 0
    """Number of joints that move it; number of joints + 1 for the flange."""
    axes: tuple[int, ...] = ()
    """External axes of the robot that move the frame of a positioner, outermost first."""
    belt: int | None = None
    """Index of the belt of a conveyor."""


WORLD = SceneFrame()


@value_class(frozen=True, slots=True, eq=False)
class AttachedBody:
    """Attachment of a body to a frame from an instant on."""

    from_s: float
    frame: SceneFrame
    frame_from_body: Transform


@value_class(frozen=True, slots=True, eq=False)
class Body:
    """One body of the cell."""

    label: BodyName
    shape: Shape
    carried: tuple[AttachedBody, ...]
    """Attachments in order of time, the first from the start on."""
    from_s: float = -np.inf
    until_s: float = np.inf
    """Interval [s] in which the body exists."""

    @property
    def is_static(self) -> bool:
        """Whether the body never moves."""
        return len(self.carried) == 1 and self.carried[0].frame == WORLD

    @property
    def spans(self) -> Iterator[tuple[AttachedBody, float, float]]:
        """Each attachment with its interval [s]; the first counts before, too."""
        later = [one.from_s for one in self.carried[1:]]
        return zip(self.carried, [-np.inf, *later], [*later, np.inf], strict=True)

    @property
    def is_lasting(self) -> bool:
        """Whether the body exists at all times."""
        return self.from_s == -np.inf and self.until_s == np.inf

    def exists(self, time_s: float) -> bool:
        """Whether the body exists at an instant [s]."""
        return self.from_s <= time_s < self.until_s


@value_class(frozen=True, slots=True, eq=False)
class Pair:
    """Two bodies that must not touch; a stationary one is the second."""

    first: int
    second: int
    owner: int
    """Index of the robot whose move it is."""
    touch_only: bool
    """Whether only contacts are checked, no clearance: for links of one arm, and for a part and the
    body it lies on."""
    from_s: float = -np.inf
    until_s: float = np.inf
    """Interval [s] in which this robot moves them; others are pairs of their own."""


@value_class(frozen=True, slots=True, eq=False)
class Arm:
    """A robot with its motion."""

    robot: Robot
    world_from_base: Transform
    """Base frame with all external axes at zero."""
    at: Callable[[Array], JointSamples]
    """Returns its axes at some instants (k,) [s]."""
    busy: tuple[tuple[float, float], ...]
    """Intervals [s] in which it may move."""
    brief_s: Array = field(default_factory=lambda: np.zeros(0))
    """Middles [s] of moves that are shorter than a step."""


@value_class(frozen=True, slots=True, eq=False)
class Poses:
    """Poses of all bodies at some instants."""

    times: Array
    """Shape (k,)"""
    rotation: Array
    """Shape (k, b, 3, 3)"""
    translation: Array
    """Shape (k, b, 3)"""
    moves: npt.NDArray[np.int64]
    """Shape (k, r): move of each robot."""

    def of(self, body: int) -> Transform:
        """Return the poses of one body in the world (k,)."""
        return Transform(self.rotation[:, body], self.translation[:, body])

    def seen(self, first: Bodily, second: Bodily, at: Bodily | slice = _ALL) -> Transform:
        """Return second_from_first of two bodies, or of pairs at some instants (k,)."""
        back = np.swapaxes(self.rotation[at, second], 1, 2)
        apart = self.translation[at, first] - self.translation[at, second]
        return Transform(back @ self.rotation[at, first], np.einsum("kij,kj->ki", back, apart))

    def and_also(self, other: Poses) -> Poses:
        """Return these poses followed by others."""
        return Poses(
            np.concatenate([self.times, other.times]),
            np.concatenate([self.rotation, other.rotation]),
            np.concatenate([self.translation, other.translation]),
            np.concatenate([self.moves, other.moves]),
        )


@value_class(frozen=True, slots=True, eq=False)
class Belt:
    """The belt of a conveyor with its motion."""

    world_from_switch: Transform
    """Frame of the switch; the belt travels along its x axis."""
    times: Array
    """Instants (k,) [s] between which its speed is constant, from the start to the end."""
    travel: Array
    """Travel (k,) [m] until then."""

    def frames(self, times: Array) -> Transform:
        """Return the frames (k,) of the belt, which are that of the switch at the start."""
        travel = np.interp(times, self.times, self.travel)
        along = self.world_from_switch.rotation[:, 0]
        rotation = np.broadcast_to(self.world_from_switch.rotation, (len(times), 3, 3))
        return Transform(rotation, self.world_from_switch.translation + travel[:, None] * along)


@value_class(frozen=True, slots=True, eq=False)
class Scene:
    """Arms and bodies."""

    arms: tuple[Arm, ...]
    bodies: tuple[Body, ...]
    pairs: tuple[Pair, ...]
    belts: tuple[Belt, ...] = ()

    def shapes(self) -> Bodies:
        """Return the bodies prepared for distance computation."""
        return Bodies([body.shape for body in self.bodies])

    def poses(self, times: Array) -> Poses:
        """Return the poses of all bodies at instants (k,) [s]."""
        count = len(times)
        rotation = np.empty((count, len(self.bodies), 3, 3))
        translation = np.empty((count, len(self.bodies), 3))
        moves = np.zeros((count, len(self.arms)), dtype=np.int64)
        frames: dict[SceneFrame, Transform] = {}
        used = {one.frame for body in self.bodies for one in body.carried}
        for number, arm in enumerate(self.arms):
            postures = arm.at(times)
            moves[:, number] = postures.move
            frames.update(arm_frames(number, arm, postures, used))
        for number, belt in enumerate(self.belts):
            frames[SceneFrame(belt=number)] = belt.frames(times)
        begin, last = (times.min(), times.max()) if count else (0.0, 0.0)
        for number, body in enumerate(self.bodies):
            spans = [
                (one, from_s, until_s)
                for one, from_s, until_s in body.spans
                if from_s <= last and until_s > begin
            ]
            for carried, from_s, until_s in spans:
                rows: slice | npt.NDArray[np.bool_] = slice(None)
                if len(spans) > 1:
                    rows = (times >= from_s) & (times < until_s)
                pose = carried.frame_from_body
                if carried.frame != WORLD:
                    pose = frames[carried.frame][rows] @ pose
                rotation[rows, number], translation[rows, number] = pose.rotation, pose.translation
        return Poses(times, rotation, translation, moves)


def arm_frames(
    number: int, arm: Arm, postures: JointSamples, used: Iterable[SceneFrame]
) -> Mapping[SceneFrame, Transform]:
    """Return world_from_link (k,) of base, links and flange of an arm, and of its positioners.

    For positioners only the used frames.
    """
    joints = postures.joints
    count = len(joints)
    world_from_base = arm.world_from_base
    if arm.robot.external:
        world_from_base = world_from_base_at(arm.robot.external, world_from_base, postures.external)
    base_from_link = arm.robot.kinematics.link_frames(joints)
    base = Transform(
        np.broadcast_to(world_from_base.rotation, (count, 3, 3)),
        np.broadcast_to(world_from_base.translation, (count, 3)),
    )
    frames = {SceneFrame(number, 0): base}
    for link in range(joints.shape[1]):
        frames[SceneFrame(number, link + 1)] = base @ base_from_link[:, link]
    for frame in used:
        if frame.robot == number and frame.axes:
            external = postures.external
            frames[frame] = world_from_unit_at(arm.robot.external, frame.axes, external)
    flange = last_link_from_flange(arm.robot)
    frames[SceneFrame(number, joints.shape[1] + 1)] = (
        frames[SceneFrame(number, joints.shape[1])] @ flange
    )
    return frames


def last_link_from_flange(robot: Robot) -> Transform:
    """Return the pose of the flange on the last link, which is constant."""
    zero = np.zeros(len(robot.joints))
    base_from_links = robot.kinematics.link_frames(zero)
    return base_from_links[-1].inverse() @ robot.kinematics.forward(zero)
