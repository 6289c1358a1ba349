"""Colours of all output by meaning, on light and on dark ground, in the notation of style sheets.

Pages, pictures and recordings take them from here, so that a joint, a kind of move or an error
looks alike everywhere. Those of the terminal are its own sixteen (`report/palette.py`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from types import MappingProxyType

from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Colours:
    """Colours on one ground."""

    name: str
    page: str
    panel: str
    """Ground of text and pictures."""
    ink: str
    soft: str
    """Text beside the main text."""
    rule: str
    faint: str
    """Ground of what is set apart on a panel."""
    accent: str
    good: str
    warning: str
    error: str
    note: str
    pointer: str
    """Ground of the line at the program pointer."""
    motion: str
    """Ground of the line whose move is under way."""
    programmed: str
    tcp: str
    arm: str
    arm_edge: str
    moves: Mapping[str, str]
    """Kinds of moves, and corners, by name."""
    joints: tuple[str, ...]
    """Axes 1, 2, ...; of more axes they repeat."""


LIGHT = Colours(
    name="light",
    page="#f4f5f7",
    panel="#ffffff",
    ink="#1b2330",
    soft="#5c6675",
    rule="#dde1e7",
    faint="#eef0f3",
    accent="#0b62c4",
    good="#17803d",
    warning="#9a5000",
    error="#c62828",
    note="#3a6ea5",
    pointer="#d8e7fb",
    motion="#d6f2df",
    programmed="#8a93a1",
    tcp="#d97800",
    arm="#f0781e",
    arm_edge="#a44a12",
    moves=MappingProxyType(
        {
            "joint": "#2f6fe0",
            "axes": "#6a5be8",
            "line": "#14954f",
            "circle": "#b53bb8",
            "corner": "#e08a00",
        }
    ),
    joints=(
        "#d93b38", "#2f9a44", "#2f6fe0", "#c79000", "#9440b8", "#0f97ad", "#e0663c", "#77828c",
    ),
)  # fmt: skip
DARK = Colours(
    name="dark",
    page="#13161b",
    panel="#1b1f26",
    ink="#e6e9ee",
    soft="#98a2b1",
    rule="#2e3540",
    faint="#232932",
    accent="#6db1ff",
    good="#58c77f",
    warning="#ffb04d",
    error="#ff6b62",
    note="#8fc0f0",
    pointer="#1d3a5f",
    motion="#17402a",
    programmed="#7d8796",
    tcp="#ffa12e",
    arm="#f0781e",
    arm_edge="#8f4a1a",
    moves=MappingProxyType(
        {
            "joint": "#5b96ff",
            "axes": "#9184ff",
            "line": "#3fd07c",
            "circle": "#e26be4",
            "corner": "#ffc107",
        }
    ),
    joints=(
        "#ef5350", "#66bb6a", "#4f93ff", "#ffca28", "#c17bd3", "#26c6da", "#ff8a65", "#b0bec5",
    ),
)  # fmt: skip
SPEEDS = (
    "#3e26a8", "#404ee6", "#2c7bf5", "#12a3dc", "#18beb4",
    "#50cd6e", "#b4cd32", "#facd32", "#ff8c28", "#ff4646",
)  # fmt: skip
"""From slow to fast, one per tenth of the range."""


def style_variables(dark: str = "@media (prefers-color-scheme: dark) { :root") -> str:
    """Return the rules of a style sheet that declare the colours as variables, `--ink` or `--j1`.

    Args:
        dark: How the rule of the dark colours begins; by default they follow the system.
    """
    closed = "}" * (1 + dark.count("{"))
    light = f":root {{ color-scheme: light; {_variables(LIGHT)} }}"
    return f"{light}\n{dark} {{ color-scheme: dark; {_variables(DARK)} {closed}\n"


def _variables(colours: Colours) -> str:
    values: dict[str, str] = {}
    for field in fields(colours)[1:]:
        match getattr(colours, field.name):
            case str(colour):
                values[field.name.replace("_", "-")] = colour
            case tuple(joints):
                values |= {f"j{number}": colour for number, colour in enumerate(joints, 1)}
            case moves:
                values |= moves
    return " ".join(f"--{name}: {colour};" for name, colour in values.items())
