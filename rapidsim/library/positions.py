r"""Positions and frames: displacing, composing and mirroring them.

Source: Technical reference manual RAPID Instructions, Functions and Data types. The order of
RelTool's rotations (x, then the new y, then the new z) is the customary reading of its text.
"""

from __future__ import annotations

import math

from rapidsim.frames import quaternion
from rapidsim.frames.quaternion import Quaternion, Vector
from rapidsim.frames.vectors import crossed, dot, length, minus, plus, scaled
from rapidsim.language.annotations import Num, Switch
from rapidsim.language.data import WOBJ0, Orient, Pos, Pose, RobTarget, WobjData
from rapidsim.language.error_numbers import ERR_ARGVALERR, ERR_FRAME, rapid_error
from rapidsim.library.poses import composed, from_axes, inverted, normalised, rounded, unit
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

_X: Vector = (1.0, 0.0, 0.0)
_Y: Vector = (0.0, 1.0, 0.0)
_Z: Vector = (0.0, 0.0, 1.0)


def offs(point: RobTarget, x_offset: Num, y_offset: Num, z_offset: Num) -> RobTarget:
    """A target displaced [mm] along the axes of its work object."""
    x, y, z = point.trans
    trans = Pos(x + x_offset, y + y_offset, z + z_offset)
    return RobTarget(trans, point.rot, point.robconf, point.extax)


def rel_tool(
    point: RobTarget,
    dx: Num,
    dy: Num,
    dz: Num,
    *,
    rx: Num | None = None,
    ry: Num | None = None,
    rz: Num | None = None,
) -> RobTarget:
    """A target displaced [mm] and turned [deg] in the tool's own frame."""
    object_from_tool = unit(point.rot)
    turn: Quaternion = quaternion.IDENTITY
    for axis, angle in ((_X, rx), (_Y, ry), (_Z, rz)):
        if angle is not None:
            about = quaternion.from_axis_angle(axis, math.radians(angle))
            turn = quaternion.multiply(turn, about)
    trans = plus(point.trans, quaternion.rotate(object_from_tool, (dx, dy, dz)))
    return point._replace(
        trans=Pos(*trans), rot=Orient(*quaternion.multiply(object_from_tool, turn))
    )


def orient_zyx(z_angle: Num, y_angle: Num, x_angle: Num) -> Orient:
    """The orientation Rz Ry Rx of three angles [deg]."""
    return Orient(
        *quaternion.from_zyx(math.radians(z_angle), math.radians(y_angle), math.radians(x_angle))
    )


def euler_zyx(rotation: Orient, *, x: Switch = False, y: Switch = False, z: Switch = False) -> Num:
    """One of the angles [deg] of `orient_zyx`; y is within -90..90.

    With y at 90 or -90 only the sum or difference of the others is defined; then x is 0.
    """
    if not (x or y or z):
        raise rapid_error(ERR_ARGVALERR, r"EulerZYX needs one of \X, \Y and \Z")
    q1, q2, q3, q4 = unit(rotation)
    sine = 2.0 * (q1 * q3 - q2 * q4)
    # The columns' lengths: cosine of y, without the loss of digits near 90 degrees.
    along_x = 1.0 - 2.0 * (q3 * q3 + q4 * q4)
    along_y = 2.0 * (q2 * q3 + q1 * q4)
    cosine = math.hypot(along_x, along_y)
    if y:
        return math.degrees(math.atan2(sine, cosine))
    # Single precision has 7 digits: a cosine below this is 0 apart from the rounding of its
    # components.
    if cosine < 1e-6:
        turned = math.atan2(-2.0 * (q2 * q3 - q1 * q4), 1.0 - 2.0 * (q2 * q2 + q4 * q4))
        return 0.0 if x else math.degrees(turned)
    if z:
        return math.degrees(math.atan2(along_y, along_x))
    return math.degrees(math.atan2(2.0 * (q3 * q4 + q1 * q2), 1.0 - 2.0 * (q2 * q2 + q3 * q3)))


def n_orient(rotation: Orient) -> Orient:
    """The orientation with unit length."""
    return Orient(*normalised(rotation))


def pose_mult(pose1: Pose, pose2: Pose) -> Pose:
    """The composition of two frames: a_from_b b_from_c, the second relative to the first."""
    return rounded(composed(pose1, pose2))


def pose_inv(pose: Pose) -> Pose:
    """The inverse of a frame: b_from_a of a_from_b."""
    return rounded(inverted(pose))


def pose_vect(pose: Pose, pos: Pos) -> Pos:
    """A position [mm] in a frame, transformed to the frame's reference."""
    return Pos(*plus(pose.trans, quaternion.rotate(unit(pose.rot), pos)))


def def_frame(
    new_p1: RobTarget, new_p2: RobTarget, new_p3: RobTarget, *, origin: Num | None = None
) -> Pose:
    r"""The frame of three points: x from the first to the second, the third towards positive y.

    Its origin is the first point, with \Origin:=2 the second, with \Origin:=3 the point of the
    x axis nearest to the third.
    """
    p1, p2, p3 = new_p1.trans, new_p2.trans, new_p3.trans
    along = minus(p2, p1)
    reach = length(along)
    aside = crossed(along, minus(p3, p1))
    area = length(aside)
    # The test uses the angle of the two arms, not the area: single precision resolves 1e-4 rad.
    if reach == 0.0 or area <= 1e-4 * reach * length(minus(p3, p1)):
        raise rapid_error(ERR_FRAME, "the three points lie on one line and define no frame")
    x_axis = scaled(along, 1.0 / reach)
    z_axis = scaled(aside, 1.0 / area)
    rotation = from_axes(x_axis, crossed(z_axis, x_axis), z_axis)
    match origin:
        case None | 1:
            at: Vector = p1
        case 2:
            at = p2
        case 3:
            at = plus(p1, scaled(x_axis, dot(minus(p3, p1), x_axis)))
        case _:
            raise rapid_error(ERR_ARGVALERR, f"there is no origin {origin:g}; origins are 1..3")
    return Pose(Pos(*at), Orient(*rotation))


def def_d_frame(
    old_p1: RobTarget,
    old_p2: RobTarget,
    old_p3: RobTarget,
    new_p1: RobTarget,
    new_p2: RobTarget,
    new_p3: RobTarget,
) -> Pose:
    """The displacement that maps three old points to three new ones."""
    old, new = def_frame(old_p1, old_p2, old_p3), def_frame(new_p1, new_p2, new_p3)
    return rounded(composed(new, inverted(old)))


def mir_pos(
    point: RobTarget,
    mir_plane: WobjData,
    *,
    wobj: WobjData | None = None,
    mir_y: Switch = False,
) -> RobTarget:
    r"""A target mirrored in the xy plane of a work object.

    A mirrored tool frame is left-handed; inverting its x axis (with \MirY its y axis) makes it
    right-handed again.
    """
    object_ = WOBJ0 if wobj is None else wobj
    world_from_object = composed(object_.uframe, object_.oframe)
    world_from_plane = composed(mir_plane.uframe, mir_plane.oframe)
    plane_from_object = composed(inverted(world_from_plane), world_from_object)
    plane_from_tool = composed(plane_from_object, Pose(point.trans, point.rot))
    x, y, z = plane_from_tool.trans
    axes = [quaternion.rotate(unit(plane_from_tool.rot), axis) for axis in (_X, _Y, _Z)]
    mirrored = [(ax, ay, -az) for ax, ay, az in axes]
    turned = 1 if mir_y else 0
    mirrored[turned] = scaled(mirrored[turned], -1.0)
    plane_from_image = Pose(Pos(x, y, -z), Orient(*from_axes(*mirrored)))
    image = rounded(composed(inverted(plane_from_object), plane_from_image))
    return point._replace(trans=image.trans, rot=image.rot)


def distance(point1: Pos, point2: Pos) -> Num:
    """The distance of two points [mm]."""
    return math.dist(point1, point2)


def dot_prod(vector1: Pos, vector2: Pos) -> Num:
    """The scalar product of two vectors."""
    return dot(vector1, vector2)


def cross_prod(vector1: Pos, vector2: Pos) -> Pos:
    """The vector product of two vectors."""
    return Pos(*crossed(vector1, vector2))


def vect_magn(vector: Pos) -> Num:
    """The length of a vector."""
    return length(vector)


POSITIONS = table(
    routine("Offs", offs, does=Trait.OFFSET),
    routine("RelTool", rel_tool, does=Trait.OFFSET | Trait.ANGLES),
    routine("OrientZYX", orient_zyx, "ZAngle YAngle XAngle", does=Trait.ANGLES),
    routine("EulerZYX", euler_zyx, r"\X|\Y|\Z Rotation"),
    routine("NOrient", n_orient),
    routine("PoseMult", pose_mult),
    routine("PoseInv", pose_inv),
    routine("PoseVect", pose_vect),
    routine("DefFrame", def_frame),
    routine("DefDFrame", def_d_frame),
    routine("MirPos", mir_pos),
    routine("Distance", distance),
    routine("DotProd", dot_prod),
    routine("CrossProd", cross_prod),
    routine("VectMagn", vect_magn),
)
