"""STEP files (AP214) of prisms: an outline in the plane z = 0, swept along z."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import dist

Point = tuple[float, float, float]
Outline = Sequence[tuple[float, float]]
UNITS = {"mm": 1.0, "inch": 25.4}
_FILE = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));
ENDSEC;
DATA;
{0}
ENDSEC;
END-ISO-10303-21;
"""


class _Prism:
    """Instances of a file: each is added after those that it refers to."""

    def __init__(self, outline: Outline, height: float) -> None:
        self.lines: list[str] = []
        self._corners: list[Point] = [(x, y, z) for z in (0.0, height) for x, y in outline]
        self._vertices = [self.add("VERTEX_POINT", "''", self.point(at)) for at in self._corners]
        self._edges: dict[tuple[int, int], str] = {}

    def add(self, name: str, *arguments: str) -> str:
        return self.add_text(f"{name}({','.join(arguments)})")

    def add_text(self, text: str) -> str:
        self.lines.append(f"#{len(self.lines) + 1}={text};")
        return f"#{len(self.lines)}"

    def point(self, at: Point, name: str = "CARTESIAN_POINT") -> str:
        return self.add(name, "''", f"({','.join(f'{float(x):.9f}' for x in at)})")

    def direction(self, along: Point) -> str:
        return self.point(along, "DIRECTION")

    def axes(self, at: Point, z: Point, x: Point) -> str:
        arguments = (self.point(at), self.direction(z), self.direction(x))
        return self.add("AXIS2_PLACEMENT_3D", "''", *arguments)

    def face(self, ring: Sequence[int], normal: Point) -> str:
        """Add a plane face whose corners have these numbers, anticlockwise seen from outside."""
        edges = [self._oriented_edge(*ends) for ends in pairwise((*ring, ring[0]))]
        loop = self.add("EDGE_LOOP", "''", f"({','.join(edges)})")
        bound = self.add("FACE_OUTER_BOUND", "''", loop, ".T.")
        first, second = (self._corners[number] for number in ring[:2])
        plane = self.add("PLANE", "''", self.axes(first, normal, _unit(first, second)))
        return self.add("ADVANCED_FACE", "''", f"({bound})", plane, ".T.")

    def _oriented_edge(self, start: int, end: int) -> str:
        forth = (end, start) not in self._edges
        if forth:
            first, second = self._corners[start], self._corners[end]
            along = self.add("VECTOR", "''", self.direction(_unit(first, second)), "1.")
            line = self.add("LINE", "''", self.point(first), along)
            ends = self._vertices[start], self._vertices[end]
            self._edges[start, end] = self.add("EDGE_CURVE", "''", *ends, line, ".T.")
        edge = self._edges[(start, end) if forth else (end, start)]
        return self.add("ORIENTED_EDGE", "''", "*", "*", edge, ".T." if forth else ".F.")


def step_prism(outline: Outline, height: float, unit: str = "mm") -> str:
    """Return the text of a file.

    Args:
        outline: Corners, anticlockwise.
        height: Length along z, in the unit, as the corners are.
        unit: One of `UNITS`.
    """
    prism, count = _Prism(outline, height), len(outline)
    add, add_text = prism.add, prism.add_text
    up, across = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    faces = [prism.face([*reversed(range(count))], (0.0, 0.0, -1.0))]
    faces.append(prism.face(range(count, 2 * count), up))
    for i, (start, end) in enumerate(pairwise((*outline, outline[0]))):
        j, (x, y, _) = (i + 1) % count, _unit((*start, 0.0), (*end, 0.0))
        faces.append(prism.face([i, j, count + j, count + i], (y, -x, 0.0)))
    solid = add("MANIFOLD_SOLID_BREP", "''", add("CLOSED_SHELL", "''", f"({','.join(faces)})"))
    length = add_text("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
    if unit != "mm":
        size = add("LENGTH_MEASURE_WITH_UNIT", f"LENGTH_MEASURE({UNITS[unit]})", length)
        power = add("DIMENSIONAL_EXPONENTS", "1.,0.,0.,0.,0.,0.,0.")
        length = add_text(f"(CONVERSION_BASED_UNIT('',{size})LENGTH_UNIT()NAMED_UNIT({power}))")
    angle = add_text("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
    solid_angle = add_text("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
    context = add_text(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
        f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle}))"
        "REPRESENTATION_CONTEXT('',''))"
    )
    items = f"({prism.axes((0.0, 0.0, 0.0), up, across)},{solid})"
    body = add("ADVANCED_BREP_SHAPE_REPRESENTATION", "''", items, context)
    field = add("APPLICATION_CONTEXT", "''")
    stage_of_product = add("PRODUCT_CONTEXT", "''", field, "''")
    product = add("PRODUCT", "''", "''", "''", f"({stage_of_product})")
    formation = add("PRODUCT_DEFINITION_FORMATION", "''", "''", product)
    stage = add("PRODUCT_DEFINITION_CONTEXT", "''", field, "''")
    definition = add("PRODUCT_DEFINITION", "''", "''", formation, stage)
    shape = add("PRODUCT_DEFINITION_SHAPE", "''", "''", definition)
    add("SHAPE_DEFINITION_REPRESENTATION", shape, body)
    return _FILE.format("\n".join(prism.lines))


def _unit(start: Point, end: Point) -> Point:
    length = dist(start, end)
    x, y, z = ((b - a) / length for a, b in zip(start, end, strict=True))
    return x, y, z
