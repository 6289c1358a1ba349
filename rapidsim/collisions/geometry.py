"""The bodies of a cell: objects, what carries them, which pairs are not checked.

Plain values, made from the station file.
"""

from __future__ import annotations

from enum import StrEnum

from rapidsim.collisions.shape import Shape
from rapidsim.frames.transform import Transform
from rapidsim.values import value_class

Colour = tuple[int, int, int]
GREY: Colour = (150, 156, 168)


class ParentKind(StrEnum):
    """What an object is fixed to."""

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
    """Of the work object, or of the mechanical unit of a positioner."""
    link: int = 0
    """How many joints move the link; of a positioner how many of its axes, 0 for all."""
    robot: str | None = None
    """The task or the label of the robot; None for the first."""


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
        """The colour as style sheets write it."""
        red, green, blue = self.colour[:3]
        return f"#{red:02x}{green:02x}{blue:02x}"


@value_class(frozen=True, slots=True, eq=False)
class Attachment:
    """While a condition on signals holds, a robot carries an object on its flange."""

    when: str
    """The condition, as a station file writes it."""
    object: str
    robot: str | None = None


@value_class(frozen=True, slots=True)
class IgnoredPair:
    """Two bodies that may touch."""

    first: str
    second: str
    reason: str


@value_class(frozen=True, slots=True, eq=False)
class CellGeometry:
    """Everything a station says about bodies."""

    objects: tuple[CellObject, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    ignored: tuple[IgnoredPair, ...] = ()
    clearance_m: float = 0.0
    """A run that comes closer than this is reported."""
    stops: bool = False
    """Whether a contact ends the run."""
    own_links: bool = True
    """Whether an arm is checked against itself."""
