"""The text that an editor shows for the name under the pointer."""

from __future__ import annotations

from collections.abc import Iterator
from math import asin, atan2, degrees, hypot

from lsprotocol import types as lsp

from rapidsim.analysis.occurrences.symbols import NamedSymbol
from rapidsim.analysis.program import DataSymbol
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.language.types import ArrayOf
from rapidsim.lsp.run_results import NO_RESULTS, RunResults
from rapidsim.lsp.texts import declaration, documentation, remark, value_text
from rapidsim.lsp.view import Document
from rapidsim.syntax import tree


def hover(
    document: Document, position: lsp.Position, results: RunResults = NO_RESULTS
) -> lsp.Hover | None:
    """Return declaration, kind, value and documentation of the name at a position.

    Args:
        document: The text.
        position: The pointer.
        results: Results of the second process, for where the arm reaches a target.
    """
    names = document.names
    found = document.name_at(position, names)
    if found is None or found.symbol is None:
        return None
    text = "\n\n".join(_paragraphs(found.symbol, names.facts, results))
    content = lsp.MarkupContent(lsp.MarkupKind.Markdown, text)
    return lsp.Hover(content, document.node_range(found.name))


def _paragraphs(symbol: NamedSymbol, facts: Facts, results: RunResults) -> Iterator[str]:
    declared = declaration(symbol)
    value = value_text(symbol)
    yield f"```rapid\n{declared}{f' := {value}' if value else ''}\n```"
    if words := remark(symbol, facts):
        yield words
    if isinstance(symbol, DataSymbol) and (pose := pose_text(symbol, facts)):
        yield pose
    if isinstance(symbol, DataSymbol):
        yield from results.about_target(symbol.name)
    if words := documentation(symbol):
        yield words


def pose_text(symbol: DataSymbol, facts: Facts) -> str:
    """Return position, rotation and configuration of a target; empty if they are not known.

    The rotation is the one about z, then y, then x of the work object [degrees].
    """
    if isinstance(symbol.type, ArrayOf) or symbol.type.name != "robtarget" or symbol.node is None:
        return ""
    known = known_value(symbol.node.value, facts)
    match _literal(symbol.node) if known is None else known:
        case ((float() as x, float() as y, float() as z), rotation, configuration, *_):
            parts = [f"Position {x:g}, {y:g}, {z:g} mm"]
            angles = euler_zyx(rotation)
            if angles is not None:
                parts.append("rotation z, y, x " + ", ".join(f"{one:.1f}" for one in angles) + "°")
            if isinstance(configuration, tuple):
                parts.append("configuration " + ", ".join(f"{one:g}" for one in configuration))
            return "; ".join(parts) + "."
        case _:
            return ""


def euler_zyx(quaternion: object) -> tuple[float, float, float] | None:
    """Rotations [degrees] about z, y and x of a quaternion, scalar first; None if it is none."""
    match quaternion:
        case (float() as w, float() as x, float() as y, float() as z):
            pass
        case _:
            return None
    norm = hypot(w, x, y, z)
    if norm < 1e-6:
        return None
    w, x, y, z = w / norm, x / norm, y / norm, z / norm
    about_y = asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    about_z = atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    about_x = atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    # Without the sum, a rotation of zero may be shown as -0.0.
    return degrees(about_z) + 0.0, degrees(about_y) + 0.0, degrees(about_x) + 0.0


def _literal(node: tree.Data) -> object:
    return node.value.value if isinstance(node.value, tree.LiteralAggregate) else None
