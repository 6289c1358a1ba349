"""Bodies of a cell: objects, their parents, and pairs that are not checked.

Plain values, built from the station file.
"""

from __future__ import annotations

from enum import StrEnum

from rapidsim.collisions.shape import Shape
from rapidsim.frames.transform import Transform
from rapidsim.values import value_class

Colour = tuple[int, int, int]
GREY: Colour = (150, 156, 168)


class ParentKind(StrEnum):
    """Kind of frame that an object is fixed to."""

    WORLD = "world"
    WOBJ = "wobj"
    LINK = "link"
    TOOL = "tool"
    UNIT = "unit"


@value_class(frozen=True, slots=True)
class Parent:
    """A frame of the cell to which objects are fixed."""

    kind: ParentKind = ParentKind.WORLD
    name: str = ""
    """Name of the work object, of the mechanical unit of a positioner, or of a body on a tool."""
    link: int = 0
    """Number of joints that move the link; for a positioner the number of its axes, 0 for all."""
    robot: str | None = None
    """Task or label of the robot; None for the first."""


@value_class(frozen=True, slots=True, eq=False)
class CellObject:
    """A body of the cell."""

    name: str
    shape: Shape
    parent: Parent
    parent_from_object: Transform
    colour: Colour = GREY

    @property
    def hex_colour(self) -> str:
        """Colour in the format of style sheets."""
        red, green, blue = self.colour[:3]
        return f"#{red:02x}{green:02x}{blue:02x}"


@value_class(frozen=True, slots=True, eq=False)
class Attachment:
    """A condition on signals under which a gripper or a clamp holds objects."""

    when: str
    """Condition, in the syntax of a station file."""
    objects: tuple[str, ...]
    """Names of the objects, of which it takes the nearest."""
    to: Parent
    """Holder: a tool, one body of it, or a unit."""
    reach_m: float
    """Largest distance [m] of an object that it takes."""


@value_class(frozen=True, slots=True)
class PartSource:
    """Appearance of copies of an object at its pose."""

    object: str
    times: tuple[float, ...] = ()
    """Times [s] of single copies."""
    first_s: float | None = None
    """Time [s] of the first of further copies; None for none."""
    every_s: float | None = None
    """Time [s] from one of those to the next; None if there is only one."""
    when: str = ""
    """Condition that makes a copy each time that it becomes true; empty for none."""


@value_class(frozen=True, slots=True)
class Sink:
    """Disappearance of parts that rest on a body."""

    surface: str
    """Name of the body, or of the surface of a conveyor, at whose end parts disappear."""
    after_s: float = 0.0
    """Time [s] that a part rests there."""
    when: str = ""
    """Condition that removes all parts each time that it becomes true; empty for none."""
    capacity: int | None = None
    """Largest number of parts; None for any."""


@value_class(frozen=True, slots=True)
class IgnoredPair:
    """Two bodies that may touch."""

    first: str
    second: str
    reason: str


@value_class(frozen=True, slots=True, eq=False)
class CellGeometry:
    """All bodies and settings for collision checking in a station file."""

    objects: tuple[CellObject, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    sources: tuple[PartSource, ...] = ()
    sinks: tuple[Sink, ...] = ()
    ignored: tuple[IgnoredPair, ...] = ()
    clearance_m: float = 0.0
    """Distance [m] below which a run is reported."""
    stops: bool = False
    """Whether a contact ends the run."""
    has_depths: bool = True
    """Whether depths of contacts are measured."""
    own_links: bool = True
    """Whether an arm is checked against itself."""
