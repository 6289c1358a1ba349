"""The path recorder: moving back along the executed path, and forward again.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "PathRecStart",
"PathRecStop", "PathRecMoveBwd", "PathRecMoveFwd", "PathRecValidBwd", "PathRecValidFwd".
"""

from __future__ import annotations

from rapidsim.language.annotations import Bool, PathRecId, Switch, Var
from rapidsim.language.data import Pos, SpeedData
from rapidsim.language.path_control import PathRecorder
from rapidsim.language.reference import Reference
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait


def path_rec_start(controller: PathRecorder, id_: Var[PathRecId]) -> None:
    """Record the path from here on; the identifier marks this position."""
    id_.value = controller.start_recording()


def path_rec_stop(controller: PathRecorder, *, clear: Switch = False) -> None:
    r"""Stop recording; with \Clear, discard what was recorded."""
    controller.stop_recording(clear=clear)


def path_rec_move_bwd(
    controller: PathRecorder,
    *,
    id_: Var[PathRecId] | None = None,
    tool_offs: Pos | None = None,
    speed: SpeedData | None = None,
) -> None:
    """Move back along the recorded path, to an identifier or to the start of the recording."""
    controller.move_backward(_number(id_), tool_offs, speed)


def path_rec_move_fwd(
    controller: PathRecorder,
    *,
    id_: Var[PathRecId] | None = None,
    tool_offs: Pos | None = None,
    speed: SpeedData | None = None,
) -> None:
    """Move forward again, to an identifier or to the start of PathRecMoveBwd."""
    controller.move_forward(_number(id_), tool_offs, speed)


def path_rec_valid_bwd(controller: PathRecorder, *, id_: Var[PathRecId] | None = None) -> Bool:
    """Whether PathRecMoveBwd can move back to an identifier."""
    return controller.can_move_backward(_number(id_))


def path_rec_valid_fwd(controller: PathRecorder, *, id_: Var[PathRecId] | None = None) -> Bool:
    """Whether PathRecMoveFwd can move forward to an identifier."""
    return controller.can_move_forward(_number(id_))


def _number(identifier: Reference[int | None] | None) -> int | None:
    """Number of a recorded position; 0, which is never used, for an unset identifier."""
    return None if identifier is None else identifier.value or 0


PATH_RECORDER = table(
    routine("PathRecStart", path_rec_start, "ID"),
    routine("PathRecStop", path_rec_stop),
    routine("PathRecMoveBwd", path_rec_move_bwd, r"\ID \ToolOffs \Speed", does=Trait.LEAVE_PATH),
    routine("PathRecMoveFwd", path_rec_move_fwd, r"\ID \ToolOffs \Speed", does=Trait.LEAVE_PATH),
    routine("PathRecValidBwd", path_rec_valid_bwd, r"\ID"),
    routine("PathRecValidFwd", path_rec_valid_fwd, r"\ID"),
)
