"""Tool: the TCP's frame on the flange, and a slim body from the flange to the TCP.

A program may change tools, or a tool's frame; the recording follows. A tool with its TCP in the
flange (`tool0`) has no body, nor has a stationary tool.
"""

from __future__ import annotations

import numpy as np
import rerun as rr

from rapidsim.frames.transform import Array, Transform, matrix_from_quaternion
from rapidsim.recording import palette
from rapidsim.recording.frame_changes import FrameChange, changes, stacked
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.scene.arm import FLANGE
from rapidsim.recording.scene.stick_figure import z_to
from rapidsim.recording.transforms import WORLD, moving_frame

TCP = "tcp"
FRAME_ENTITY = "robot/tcp"
BODY_ENTITY = "robot/tool"

_SHORTEST = 1e-3
"""Distance [m] of a TCP from the flange below which it has no body."""
_SIDES = 24


def log_tool(stream: rr.RecordingStream, run: RecordedRobot, axis_m: float) -> None:
    """Log the TCP with axes of a length [m] and the tool's body."""
    flange = run.frame(FLANGE)
    moves = run.robot_run.moves
    programmed = moves.columns.templates
    tools = changes(
        (
            moves[at]
            for at, move in enumerate(programmed)
            if at == 0 or move.tool is not programmed[at - 1].tool
        ),
        lambda move: move.move.tool.tframe,
        # A stationary tool is fixed in the world, and the arm moves the work to it.
        lambda move: flange if move.move.tool.robhold else WORLD,
    ) or (FrameChange(0.0, Transform.identity(), flange),)
    stream.send_columns(
        run.entity(FRAME_ENTITY),
        indexes=run.clock.columns([tool.time_s for tool in tools]),
        columns=moving_frame([tool.parent for tool in tools], run.frame(TCP), stacked(tools)),
    )
    tcp = run.entity(FRAME_ENTITY)
    stream.log(tcp, rr.CoordinateFrame(run.frame(TCP)), rr.TransformAxes3D(axis_m), static=True)
    body = run.entity(BODY_ENTITY)
    stream.log(body, rr.CoordinateFrame(flange), static=True)
    for tool in tools:
        run.clock.set(stream, tool.time_s)
        held = tool.parent == flange
        stream.log(body, tool_body(tool.frame.translation if held else np.zeros(3)))
    stream.reset_time()


def tool_body(tcp_in_flange: Array) -> rr.Mesh3D | rr.Clear:
    """Return a tapered rod from the flange to the TCP (3,) [m], round and closed at the flange."""
    length = float(np.linalg.norm(tcp_in_flange))
    if length < _SHORTEST:
        return rr.Clear(recursive=False)
    thick = min(0.011, 0.12 * length)
    x, y, z, w = z_to(tcp_in_flange / length)
    turn = matrix_from_quaternion(np.array([w, x, y, z]))
    angle = np.linspace(0.0, 2.0 * np.pi, _SIDES, endpoint=False)
    around = np.stack([np.cos(angle), np.sin(angle), np.zeros(_SIDES)], axis=1)
    rings, normals = [], []
    # Full for most of its length, then a point: a pen, a torch, a gripper's finger.
    for share, radius in ((0.0, thick), (0.7, 0.8 * thick), (1.0, 0.12 * thick)):
        rings.append(around * radius + [0.0, 0.0, share * length])
        normals.append(around)
    points = np.concatenate([*rings, [[0.0, 0.0, 0.0]]]) @ turn.T
    outward = np.concatenate([*normals, [[0.0, 0.0, -1.0]]]) @ turn.T
    side = np.arange(_SIDES)
    following = (side + 1) % _SIDES
    triangles = [np.stack([np.full(_SIDES, 3 * _SIDES), following, side], axis=1)]
    for ring in (0, _SIDES):
        low, high = ring + side, ring + _SIDES + side
        low_next, high_next = ring + following, ring + _SIDES + following
        triangles.append(np.stack([low, low_next, high], axis=1))
        triangles.append(np.stack([high, low_next, high_next], axis=1))
    return rr.Mesh3D(
        vertex_positions=points,
        vertex_normals=outward,
        triangle_indices=np.concatenate(triangles),
        albedo_factor=palette.rgba(palette.TOOL),
    )
