"""A robot: its kinematics with the limits, speeds and names that make it a product."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, cached_property
from pathlib import Path
from typing import Final

import numpy as np

from rapidsim.extras import require
from rapidsim.files import DESCRIPTIONS
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import METRES_PER_UNIT, Branches, Kinematics
from rapidsim.motion.kinematics.numerical.revolute_chain import AxisRowGeometry, search_notices
from rapidsim.motion.robot.catalogue import (
    CatalogueEntry,
    RobotError,
    entry_name,
    find_entry,
    kinematics_of,
    robot_names,
    speed_lender,
)
from rapidsim.motion.robot.external_axes import Axes, ExternalAxis
from rapidsim.motion.robot.known_constants import ReferenceCycle, ReferenceVolume
from rapidsim.motion.robot.motion_constants import (
    MotionConstants,
    constants_of,
    constants_of_version_2,
)
from rapidsim.notebook import card
from rapidsim.values import value_class

__all__ = ["Joint", "Robot", "RobotError", "load_robot", "robot_names"]


@value_class(frozen=True, slots=True)
class Joint:
    """One joint of an arm, with name and limits."""

    name: str
    lower: float
    """[rad]"""
    upper: float
    """[rad]"""
    max_speed: float | None
    """[rad/s]; None if no source has it."""
    max_acceleration: float | None = None
    """[rad/s2], for version 1 of the motion model; None unless measured."""
    slides: bool = False
    """Whether it slides: then all its values are mm * pi / 180; see `Kinematics`."""

    @property
    def measure(self) -> str:
        """RAPID's unit for its values."""
        return "mm" if self.slides else "deg"

    def within(self, lower: float, upper: float) -> Joint:
        """Return the joint with other limits [rad], [m] if it slides."""
        return replace(self, lower=lower / self.unit, upper=upper / self.unit)

    @property
    def unit(self) -> float:
        """One unit of its values: 1 rad, or a length in metres if it slides."""
        return METRES_PER_UNIT if self.slides else 1.0


@value_class(frozen=True, slots=True)
class LinkMeshes:
    """Files with the shapes of an arm's links, the base first."""

    files: tuple[Path, ...]
    units_m: tuple[float, ...]
    """Length [m] of the unit of each file."""
    in_base: bool
    """Whether all are drawn in the base frame with the joints at zero; else each in the frame of
    its
    link: the origin on its axis, and parallel to the base with the joints at zero."""


LARGEST_EXCESS: Final = (0.18, 0.07)
"""Largest known `Robot.link_excess_m` as a share of the reach: of all links, and of links from the
third on."""


@value_class(frozen=True, eq=False, repr=False)
class Robot:
    """An arm with limits, external axes and shapes."""

    name: str
    """Catalogue name, such as `irb1600-6-1.2`."""
    title: str
    """Name as written by its maker: `ABB IRB 1600-6/1.2`."""
    joints: tuple[Joint, ...]
    kinematics: Kinematics
    urdf: Path | None
    """Description with link shapes, for the recording and other tools; None if there is none."""
    payload_kg: float | None = None
    reach_m: float | None = None
    maker: str | None = None
    """None for a URDF, which does not contain it."""
    sources: tuple[str, ...] = ()
    """Sources of the numbers."""
    notices: tuple[str, ...] = ()
    """Notices for the user about the solver of this arm; commands print them."""
    checks: tuple[str, ...] = ()
    """Sources with which the figures were compared."""
    notes: tuple[str, ...] = ()
    not_modelled: tuple[str, ...] = ()
    """Properties of the arm that a run does not model."""
    axis_speeds_from: str | None = None
    """Arm of the catalogue whose axis speeds are used; None if the speeds are this arm's."""
    link_excess_m: tuple[float, ...] = ()
    """Distance [m] by which 95 % of the surface of the maker's links extend at most beyond ours,
    the base first; empty if not compared."""
    constants: MotionConstants = MotionConstants()
    """Constants of the motion model."""
    constants_2: MotionConstants = MotionConstants()
    """Constants of version 2 of the motion model."""
    picking: ReferenceCycle | None = None
    """Figure for its picking cycle; None if there is none."""
    wrist_centre_volume: ReferenceVolume | None = None
    """Figure for the volume that its wrist centre reaches; None if there is none."""
    external: tuple[ExternalAxis, ...] = ()
    """Axes outside the arm, in the order of their letters; defined in the station file."""
    meshes: LinkMeshes | None = None
    """Shapes that replace the shapes of the description; None to keep these."""

    def units(self, per: str = "") -> str:
        """Return RAPID's units of all joints, such as `deg/s` or, if one slides, `deg, j3 in mm`.

        Args:
            per: Suffix of each unit, such as `/s`.
        """
        sliding = [f", j{n} in mm{per}" for n, joint in enumerate(self.joints, 1) if joint.slides]
        return "".join([f"deg{per}", *sliding])

    @cached_property
    def lower(self) -> Array:
        """Lower joint limits (n,) [rad]."""
        return np.array([joint.lower for joint in self.joints])

    @cached_property
    def upper(self) -> Array:
        """Upper joint limits (n,) [rad]."""
        return np.array([joint.upper for joint in self.joints])

    @cached_property
    def axes(self) -> Axes:
        """Joints of the arm and external axes with their limits."""
        return Axes(
            np.append(self.lower, [axis.lower for axis in self.external]),
            np.append(self.upper, [axis.upper for axis in self.external]),
            self.external,
            tuple(joint.slides for joint in self.joints),
        )

    @cached_property
    def start(self) -> Array:
        """Joints (n,) [rad] of the posture in which a run begins unless specified.

        Away from singularities, as a program may begin with a line; if the arm has no preferred
        posture, the middle of its limits. Always within these.
        """
        posture = self.kinematics.posture
        if posture is not None:
            return np.clip(posture, self.lower, self.upper)
        endless = np.isinf(self.lower) | np.isinf(self.upper)
        return np.where(endless, 0.0, (self.lower + self.upper) / 2.0)

    def _repr_html_(self) -> str:
        """Card for notebooks: limits and speeds of the joints."""
        figures = {
            "name": self.name,
            **({"payload": f"{self.payload_kg:g} kg"} if self.payload_kg is not None else {}),
            **({"reach": f"{1000.0 * self.reach_m:.0f} mm"} if self.reach_m is not None else {}),
        }
        rows = [
            (
                joint.name,
                f"{np.degrees(joint.lower):.1f} to {np.degrees(joint.upper):.1f} {joint.measure}",
                "unknown"
                if joint.max_speed is None
                else f"{np.degrees(joint.max_speed):.0f} {joint.measure}/s",
            )
            for joint in self.joints
        ]
        return card(self.title, figures, heads=("joint", "range", "speed"), rows=rows)

    def __repr__(self) -> str:
        """Return one line with name and number of axes."""
        return f"<robot {self.name[:60]}, {len(self.joints)} axes>"

    def forward(self, joints: Array) -> Transform:
        """Return base_from_flange of joint vectors (..., n) [rad]; ABB's flange is tool0."""
        return self.kinematics.forward(np.asarray(joints, dtype=np.float64))

    def inverse(self, base_from_flange: Transform) -> Branches:
        """Return all branches of poses (...,), without the limits of `confdata.configurations`."""
        return self.kinematics.inverse(base_from_flange)


def load_robot(name_or_path: str | Path, scale: float | None = None) -> Robot:
    """Load a robot from the catalogue by name or alias, or from a URDF by path.

    Args:
        name_or_path: The name or path.
        scale: Factor for the lengths of a URDF, 0.001 for one in mm. Its links are then drawn as
            bars.

    Raises:
        RobotError: If the name is unknown, the file cannot be read, or the kind of arm is not
            supported; the message contains the reason.
        InputError: If the package that reads URDF files is not installed.
    """
    text = str(name_or_path)
    if isinstance(name_or_path, Path) or text.lower().endswith(DESCRIPTIONS):
        require("yourdfpy", "a robot from a URDF")
        # Importing yourdfpy takes two seconds, which a robot of the catalogue does not need.
        from rapidsim.motion.robot.urdf import robot_parts_from_urdf  # noqa: PLC0415

        parts = robot_parts_from_urdf(Path(text), 1.0 if scale is None else scale)
        joints = tuple(
            Joint(name, lower, upper, speed, slides=slides)
            for name, (lower, upper), speed, slides in zip(
                parts.joint_names,
                parts.limits,
                parts.max_speeds,
                parts.kinematics.slides.tolist(),
                strict=True,
            )
        )
        return Robot(
            name=parts.name,
            title=parts.name,
            joints=joints,
            kinematics=parts.kinematics,
            # Shapes of a scaled description would keep the size in the file.
            urdf=Path(text) if scale is None else None,
            sources=(text,),
            notices=parts.notices,
        )
    if scale is not None:
        raise RobotError(f"`{text}` is in the catalogue: only lengths of a URDF file are scaled")
    return _from_catalogue(entry_name(text))


@cache
def _from_catalogue(name: str) -> Robot:
    """Return an arm of the catalogue, the same object each time: the catalogue does not change."""
    return _from_entry(find_entry(name))


def _from_entry(entry: CatalogueEntry) -> Robot:
    kinematics = kinematics_of(entry)
    lender = speed_lender(entry) if None in entry.max_speeds else None
    if lender is not None:
        entry = replace(entry, max_speeds=lender.max_speeds)
    lent = _speed_notices(entry, lender)
    return Robot(
        name=entry.name,
        title=entry.title,
        axis_speeds_from=None if lender is None else lender.name,
        joints=tuple(
            Joint(name, lower, upper, speed, acceleration, slides)
            for name, (lower, upper), speed, acceleration, slides in zip(
                entry.joint_names,
                entry.limits,
                entry.max_speeds,
                entry.max_accelerations,
                kinematics.slides.tolist(),
                strict=True,
            )
        ),
        kinematics=kinematics,
        constants=constants_of(entry, are_speeds_own=lender is None),
        constants_2=constants_of_version_2(entry),
        notices=(*_notices(entry), *entry.notices, *lent),
        urdf=entry.urdf,
        payload_kg=entry.payload_kg,
        reach_m=entry.reach_m,
        maker=entry.maker,
        sources=entry.sources,
        checks=entry.checks,
        notes=(*entry.notes, *lent),
        not_modelled=entry.not_modelled,
        picking=entry.picking,
        wrist_centre_volume=entry.wrist_centre_volume,
        link_excess_m=entry.link_excess_m,
    )


def _speed_notices(entry: CatalogueEntry, lender: CatalogueEntry | None) -> tuple[str, ...]:
    """Return notices about axis speeds taken from another arm."""
    if lender is None:
        return ()
    speeds = ", ".join(f"{speed:g}" for speed in entry.unconfirmed_speeds)
    suggested = f"; to be checked, as no source confirms them: [{speeds}]" if speeds else ""
    return (
        f"no source gives the axis speeds of {entry.name}: those of {lender.name} are used "
        f"unless [motion] axis_speed = [...] in rapidsim.toml sets them{suggested}",
    )


def _notices(entry: CatalogueEntry) -> tuple[str, ...]:
    """Return notices about an arm that is solved by search."""
    if not isinstance(entry.geometry, AxisRowGeometry):
        return ()
    count = len(entry.joint_names)
    why = (
        "its axis 6 misses the intersection of axes 4 and 5"
        if count == 6
        else f"it has {count} axes"
    )
    return search_notices(entry.name, why, count)
