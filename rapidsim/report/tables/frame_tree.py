"""The frames of a program as a tree: world, base, tools, work objects, targets.

Enters a checked program with the values of its data, leaves `FrameNode`s in RAPID's units. Targets
stand under each work object that a move names with them.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import TypeVar

from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.frames import quaternion as rotations
from rapidsim.language.data import IDENTITY_POSE, Pose, RobTarget, ToolData, WobjData
from rapidsim.reach.dataflow.written_moves import NO_WOBJ, targets_by_wobj
from rapidsim.values import value_class

T = TypeVar("T")
ValueOf = Callable[[DataSymbol], object]
"""The value of program data before the program runs."""


@value_class(frozen=True, slots=True)
class FrameNode:
    """One frame with the frames inside it."""

    name: str
    kind: str
    """`world`, `base`, `flange`, `tool`, `user`, `object` or `target`."""
    parent_from_frame: Pose
    world_from_frame: Pose | None
    """None if it depends on the posture of the arm."""
    children: tuple[FrameNode, ...] = ()
    note: str = ""


def frame_tree(
    program: Program, value_of: ValueOf, robot_name: str, world_from_base: Pose = IDENTITY_POSE
) -> FrameNode:
    """The frame tree of a program on a robot with a base frame in the world."""
    values = {symbol.name: value_of(symbol) for symbol in _data_with_frames(program)}
    tools, wobjs = _of_type(values, ToolData), _of_type(values, WobjData)
    targets = _of_type(values, RobTarget)
    used = targets_by_wobj(program)
    held = [_tool(name, tool, None) for name, tool in tools.items() if tool.robhold]
    fixed = [_tool(name, tool, IDENTITY_POSE) for name, tool in tools.items() if not tool.robhold]
    on_arm = [_work_object(n, w, used, targets, None) for n, w in wobjs.items() if w.robhold]
    standing = [
        _work_object(n, w, used, targets, IDENTITY_POSE) for n, w in wobjs.items() if not w.robhold
    ]
    in_world = [
        _target(name, targets[name], IDENTITY_POSE)
        for name in used.get(NO_WOBJ, ())
        if name in targets
    ]
    moved_to = {name for names in used.values() for name in names}
    unused = [
        _target(name, target, IDENTITY_POSE, "not used by any move")
        for name, target in targets.items()
        if name not in moved_to
    ]
    flange = FrameNode("tool0", "flange", IDENTITY_POSE, None, (*held, *on_arm), "moves")
    base = FrameNode("base", "base", world_from_base, world_from_base, (flange,), robot_name)
    children = (base, *fixed, *standing, *in_world, *unused)
    return FrameNode("world", "world", IDENTITY_POSE, IDENTITY_POSE, children)


def _data_with_frames(program: Program) -> Collection[DataSymbol]:
    """Frames in module data, without arrays: for each folded name the last declaration."""
    data = {
        symbol.name.lower(): symbol
        for symbol in program.symbol_of.values()
        if isinstance(symbol, DataSymbol)
        and symbol.node is not None
        and not symbol.node.dimensions
        and symbol.type.name in ("tooldata", "wobjdata", "robtarget")
        and _is_module_data(symbol)
    }
    return data.values()


def _of_type(values: Mapping[str, object], type_: type[T]) -> dict[str, T]:
    return {name: value for name, value in values.items() if isinstance(value, type_)}


def composed(a_from_b: Pose, b_from_c: Pose) -> Pose:
    """a_from_c, in RAPID's units."""
    a, b = a_from_b, b_from_c
    x, y, z = rotations.rotate(a.rot, b.trans)
    trans = type(a.trans)(a.trans.x + x, a.trans.y + y, a.trans.z + z)
    return Pose(trans, type(a.rot)(*rotations.multiply(a.rot, b.rot)))


def _is_module_data(symbol: DataSymbol) -> bool:
    return symbol.module is not None and symbol.node in symbol.module.items


def _tool(name: str, tool: ToolData, world_from_parent: Pose | None) -> FrameNode:
    note = f"{tool.tload.mass:g} kg" if tool.robhold else "stationary"
    return _node(name, "tool", tool.tframe, world_from_parent, note=note)


def _work_object(
    name: str,
    wobj: WobjData,
    used: Mapping[str, tuple[str, ...]],
    targets: Mapping[str, RobTarget],
    world_from_parent: Pose | None,
) -> FrameNode:
    world_from_user = composed(world_from_parent, wobj.uframe) if world_from_parent else None
    world_from_object = composed(world_from_user, wobj.oframe) if world_from_user else None
    within = tuple(
        _target(target, targets[target], world_from_object)
        for target in used.get(name.lower(), ())
        if target in targets
    )
    inner = FrameNode(f"{name}.oframe", "object", wobj.oframe, world_from_object, within)
    note = "" if wobj.ufprog else f"moved by {wobj.ufmec}"
    note = "held by the robot" if wobj.robhold else note
    return FrameNode(f"{name}.uframe", "user", wobj.uframe, world_from_user, (inner,), note)


def _target(
    name: str, target: RobTarget, world_from_object: Pose | None, note: str = ""
) -> FrameNode:
    if not any(target.rot):
        return FrameNode(
            name, "target", IDENTITY_POSE, None, note="not set before the program runs"
        )
    return _node(name, "target", Pose(target.trans, target.rot), world_from_object, note=note)


def _node(
    name: str, kind: str, parent_from_frame: Pose, world_from_parent: Pose | None, *, note: str
) -> FrameNode:
    world = composed(world_from_parent, parent_from_frame) if world_from_parent else None
    return FrameNode(name, kind, parent_from_frame, world, note=note)
