"""Text of URDF files found in practice, reduced to URDF elements.

Input is text, output is XML with URDF's own elements only, and a line for each omitted element.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from xml.etree import ElementTree
from xml.parsers import expat

from rapidsim.motion.robot.catalogue import RobotError

_DEEPEST = 100
"""Maximum depth of tags; a description needs six."""
_MOST_CHARACTERS = 10_000_000
_MOST_REMARKS = 10
_DECLARATION = re.compile(r"\s*<\?xml\b.*?\?>", re.DOTALL)

_INSIDE: Mapping[str, frozenset[str]] = MappingProxyType(
    {
        "link": frozenset({"inertial", "visual", "collision"}),
        "joint": frozenset(
            {
                "origin", "parent", "child", "axis", "calibration", "dynamics", "limit", "mimic",
                "safety_controller",
            }
        ),
        "visual": frozenset({"origin", "geometry", "material"}),
        "collision": frozenset({"origin", "geometry", "material"}),
        "geometry": frozenset({"box", "cylinder", "sphere", "mesh", "capsule"}),
        "inertial": frozenset({"origin", "mass", "inertia"}),
    }
)  # fmt: skip
"""Allowed children of the tags that a robot is read from; other tags may contain anything.

Source: the XML specification of URDF, wiki.ros.org/urdf/XML.
"""


def plain_urdf(file: Path, text: str) -> tuple[str, tuple[str, ...]]:
    """Return the URDF elements of a file, and remarks on its other content.

    Raises:
        RobotError: If it is not XML, declares entities, is too large, nested too deeply, or xacro.
    """
    # The text is already decoded: any encoding in the declaration no longer applies, so remove it.
    text, declared = _DECLARATION.sub("", text, count=1), _DECLARATION.match(text)
    # Count the lines of the removed declaration, so that messages contain line numbers of the file.
    lines_before = declared.group().count("\n") if declared else 0
    if len(text) > _MOST_CHARACTERS:
        raise RobotError(f"{file}: more than {_MOST_CHARACTERS:g} characters")
    reader = _Reader(file, lines_before)
    try:
        reader.parser.Parse(text, True)
    except expat.ExpatError as mistake:
        raise RobotError(f"{file}: not a readable URDF: {mistake}") from None
    root = reader.tree.close()
    remarks = reader.remarks[:_MOST_REMARKS]
    if len(reader.remarks) > len(remarks):
        remarks.append(f"{file}: and {len(reader.remarks) - len(remarks)} more of that kind")
    return ElementTree.tostring(root, encoding="unicode"), tuple(remarks)


class _Reader:
    """Builds a tree of URDF elements and records omitted ones."""

    def __init__(self, file: Path, lines_before: int) -> None:
        self.file = file
        self.lines_before = lines_before
        self.tree = ElementTree.TreeBuilder()
        self.remarks: list[str] = []
        self.open: list[str] = []
        self.skipped = 0
        """Number of open tags that are omitted."""
        self.parser = expat.ParserCreate()
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.end
        self.parser.CharacterDataHandler = self.data
        self.parser.StartDoctypeDeclHandler = self.document_type

    @property
    def place(self) -> str:
        """Current file and line."""
        return f"{self.file}:{self.lines_before + self.parser.CurrentLineNumber}"

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        """Handle a start tag."""
        if tag.startswith("xacro:") or any("${" in value for value in attributes.values()):
            raise RobotError(
                f"{self.place}: this is xacro, not URDF; "
                f"`xacro {self.file.name} > robot.urdf` converts it"
            )
        if len(self.open) >= _DEEPEST:
            raise RobotError(f"{self.file}: nested too deeply")
        around = self.open[-1] if self.open else ""
        self.open.append(tag)
        if self.skipped:
            self.skipped += 1
        # A joint of a transmission is not a joint of the robot, and may contain anything.
        elif tag not in _INSIDE.get(around, (tag,)) and "transmission" not in self.open:
            self.remarks.append(
                f"{self.place}: `{tag}` is not allowed inside `{around}` and is skipped"
            )
            self.skipped = 1
        else:
            self.tree.start(tag, attributes)

    def end(self, tag: str) -> None:
        """Handle an end tag."""
        self.open.pop()
        if self.skipped:
            self.skipped -= 1
        else:
            self.tree.end(tag)

    def data(self, text: str) -> None:
        """Handle text between tags."""
        if not self.skipped and self.open:
            self.tree.data(text)

    def document_type(self, *_: object) -> None:
        """Refuse entities, which can expand to gigabytes or read other files; a URDF needs none."""
        raise RobotError(f"{self.file}: a robot description must not declare XML entities")
