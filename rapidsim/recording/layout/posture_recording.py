"""Postures of an arm as one `.rrd` file: shapes, frames, all branches side by side, figures."""

from __future__ import annotations

import hashlib
import uuid
from pathlib import Path

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.postures import Posture, Postures
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.recording import palette
from rapidsim.recording.layout.blueprint import laid_out, space
from rapidsim.recording.layout.camera import looking_at
from rapidsim.recording.scene.arm import FLANGE, log_arm
from rapidsim.recording.scene.tool import TCP, tool_body
from rapidsim.recording.stream import recording_file
from rapidsim.recording.timelines import Clock
from rapidsim.recording.transforms import BASE, WORLD, static_frame
from rapidsim.values import value_class

FIGURES = "figures"
FRAMES = "frames"
NAMES = "names"
WEAKEST = "weakest"
_APART = 1.35
"""Distance between arms, relative to the size of one."""
_AXES = 0.13
_ARROW = 0.35
_OVER = 0.3
"""Height of names above arms, relative to the size of one."""
_ACROSS = 4
"""Number of arms in a row."""
_AZIMUTH = np.radians(-52.0)
_HEIGHT = np.radians(22.0)
_ROWS_AZIMUTH = np.radians(-12.0)
"""Azimuth of the camera for several arms: from the front, slightly to the side."""
_ROWS_HEIGHT = np.radians(34.0)


@value_class(frozen=True, slots=True, eq=False)
class StaticArm:
    """An arm at rest; implements `scene.arm.MovingArm`."""

    robot: Robot
    samples: Samples
    clock: Clock
    name: str

    def entity(self, path: str) -> str:
        """Return the entity path of something of this arm in the recording."""
        return f"{self.name}/{path}" if self.name else path

    def frame(self, name: str) -> str:
        """Return the full name of a frame of this arm."""
        return f"{self.name}/{name}" if self.name else name


def record_postures(postures: Postures, figures: str, path: Path) -> Path:
    """Write a recording of postures.

    Args:
        postures: Postures to show.
        figures: Markdown text of the document next to the view.
        path: Target file, which appears only when it is complete.

    Returns:
        The path written.

    Raises:
        InputError: If the file cannot be written.
    """
    places = [_place(postures, row) for row in range(len(postures.rows))]
    with recording_file(path, _content_id(postures), _blueprint(postures, places)) as stream:
        stream.send_recording_name(postures.title)
        stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, rr.CoordinateFrame(WORLD), static=True)
        remarks: tuple[str, ...] = ()
        for row, (posture, place) in enumerate(zip(postures.rows, places, strict=True)):
            name = "" if len(postures.rows) == 1 else f"branch_{row + 1}"
            remarks = _log_posture(stream, postures, posture, place, name)
            _log_frames(stream, postures, row, place)
        _log_names(stream, postures, places)
        _log_weakest(stream, postures)
        said = "".join(f"\n\n{remark}" for remark in remarks)
        document = rr.TextDocument(
            f"### {postures.title}\n\n{figures}{said}\n", media_type="text/markdown"
        )
        stream.log(FIGURES, document, static=True)
    return path


def _place(postures: Postures, row: int) -> Transform:
    """Return the displacement [m] of a posture, so that several are side by side."""
    apart = _APART * postures.size if len(postures.rows) > 1 else 0.0
    # Side by side as the camera sees them, from left to right and from the front.
    aside = np.array([-1.3 * (row // _ACROSS), row % _ACROSS, 0.0]) * apart
    return Transform(np.eye(3), aside)


def _log_posture(
    stream: rr.RecordingStream, postures: Postures, posture: Posture, place: Transform, name: str
) -> tuple[str, ...]:
    flange = postures.robot.forward(posture.joints)
    tcp = flange @ postures.flange_from_tcp
    samples = Samples(
        times=np.zeros(1),
        move=np.zeros(1, dtype=np.int64),
        joints=posture.joints[None],
        base_from_tcp=Transform(tcp.rotation[None], tcp.translation[None]),
        tcp_speed=np.zeros(1),
    )
    arm = StaticArm(postures.robot, samples, Clock(np.zeros(1)), name)
    stands = static_frame(WORLD, arm.frame(BASE), place @ postures.world_from_base)
    stream.log(arm.entity("base"), stands, static=True)
    remarks = log_arm(stream, arm).remarks
    tool = static_frame(arm.frame(FLANGE), arm.frame(TCP), postures.flange_from_tcp)
    stream.log(arm.entity("robot/tcp"), tool, static=True)
    body = tool_body(postures.flange_from_tcp.translation)
    stream.log(arm.entity("robot/tool"), rr.CoordinateFrame(arm.frame(FLANGE)), body, static=True)
    return remarks


def _log_frames(stream: rr.RecordingStream, postures: Postures, row: int, place: Transform) -> None:
    """Log the axes of all links, the flange and the TCP; over the shapes, as links hide them."""
    frames = place @ postures.frames(row)
    axis = _AXES * postures.size
    vectors = np.swapaxes(frames.rotation, -1, -2).reshape(-1, 3) * axis
    stream.log(
        f"{FRAMES}/{row + 1}",
        rr.CoordinateFrame(WORLD),
        rr.Arrows3D(
            origins=np.repeat(frames.translation, 3, axis=0),
            vectors=vectors,
            radii=[0.03 * axis],
            colors=np.tile([palette.rgba(one) for one in palette.AXES], len(frames)).astype(
                np.uint32
            ),
        ),
        static=True,
    )


def _log_names(stream: rr.RecordingStream, postures: Postures, places: list[Transform]) -> None:
    """Log the name of each of several postures, above it."""
    if len(postures.rows) == 1:
        return
    feet = np.array([place.translation for place in places]) + postures.world_from_base.translation
    tops = [postures.frames(row).translation[:, 2].max() for row in range(len(places))]
    feet[:, 2] = np.array(tops) + _OVER * postures.size
    names = [
        posture.name + ("" if posture.within_limits else ", outside the limits")
        for posture in postures.rows
    ]
    points = rr.Points3D(
        feet,
        radii=rr.Radius.ui_points(0.0),
        colors=palette.rgba(palette.TARGET_NAME),
        labels=names,
        show_labels=True,
    )
    stream.log(NAMES, rr.CoordinateFrame(WORLD), points, static=True)


def _log_weakest(stream: rr.RecordingStream, postures: Postures) -> None:
    """Log the direction in which the TCP is moved least, and its opposite."""
    weakest = postures.weakest
    if weakest is None:
        return
    direction, words = weakest
    along = _ARROW * postures.size * direction
    arrows = rr.Arrows3D(
        origins=[postures.world_from_tcp.translation] * 2,
        vectors=[along, -along],
        radii=[0.006 * postures.size],
        colors=palette.rgba(palette.FAILED),
        labels=[words, ""],
        show_labels=True,
    )
    stream.log(WEAKEST, rr.CoordinateFrame(WORLD), arrows, static=True)


def _blueprint(postures: Postures, places: list[Transform]) -> rrb.Blueprint:
    several = len(places) > 1
    azimuth, height = (_ROWS_AZIMUTH, _ROWS_HEIGHT) if several else (_AZIMUTH, _HEIGHT)
    camera = looking_at(_seen(postures, places), azimuth, height, air=1.2, wide=1.15)
    return laid_out(
        rrb.Horizontal(
            space("Arm" if len(places) == 1 else "All branches", camera, 0.1, ["+ /**"]),
            rrb.TextDocumentView(origin=f"/{FIGURES}", name="Figures"),
            column_shares=[7, 4],
        )
    )


def _seen(postures: Postures, places: list[Transform]) -> Array:
    """Return points (k, 3) [m] that the picture must contain."""
    foot = postures.world_from_base.translation
    parts = [
        place.apply(np.concatenate([foot[None], postures.frames(row).translation]))
        for row, place in enumerate(places)
    ]
    if len(places) > 1:
        parts += [part + np.array([0.0, 0.0, _OVER * postures.size]) for part in parts]
    return np.concatenate(parts)


def _content_id(postures: Postures) -> uuid.UUID:
    """Return an id that depends only on the content."""
    digest = hashlib.sha256(f"{postures.robot.name} {postures.title}".encode())
    for posture in postures.rows:
        digest.update(np.ascontiguousarray(posture.joints).tobytes())
    digest.update(np.ascontiguousarray(postures.world_from_base.matrix).tobytes())
    digest.update(np.ascontiguousarray(postures.flange_from_tcp.matrix).tobytes())
    return uuid.UUID(bytes=digest.digest()[:16])
