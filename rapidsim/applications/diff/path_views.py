"""The paths of the TCP before and after, seen from above and from the side, as SVG.

Both views have one scale, with lines at round coordinates. The path before lies beneath the one
after, and is wide, so that it is seen where both are the same.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import ceil, floor, log10

from rapidsim.values import value_class

_VIEWS = (("from above", 0, 1), ("from the side", 0, 2))
_WIDTH = 460.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 52.0, 14.0, 12.0, 24.0
"""Margins of a view, with room for coordinates."""
_FEWEST_LINES = 3
"""Number of lines at least across the longest side."""
_LEAST_SHARE = 0.15
"""Share of the longest side that a view shows of every axis: a plane path has a height, too."""

Path = Sequence[Sequence[float]]
"""Points (x, y, z) [mm]."""


@value_class(frozen=True, slots=True)
class _Axis:
    """The section [mm] of an axis that a view shows."""

    name: str
    low: float
    high: float

    def round_values(self, step: float) -> Iterator[float]:
        """Yield multiples of a step [mm] within the section."""
        for number in range(ceil(self.low / step), floor(self.high / step) + 1):
            yield number * step


@value_class(frozen=True, slots=True)
class _View:
    """Two axes on a picture, in its pixels."""

    across: _Axis
    up: _Axis
    scale: float
    """Pixels per mm."""

    @property
    def right(self) -> float:
        """Right end of the axis across."""
        return self.x(self.across.high)

    @property
    def bottom(self) -> float:
        """Lower end of the axis upwards."""
        return self.y(self.up.low)

    def x(self, value: float) -> float:
        """Return the place of a coordinate [mm] on the axis across."""
        return _LEFT + self.scale * (value - self.across.low)

    def y(self, value: float) -> float:
        """Return the place of a coordinate [mm] on the axis upwards."""
        return _TOP + self.scale * (self.up.high - value)

    def grid(self, step: float) -> str:
        """Return lines at multiples of a step [mm], with their coordinates."""
        across = (
            f'<line x1="{self.x(value):.1f}" y1="{_TOP:g}" x2="{self.x(value):.1f}" '
            f'y2="{self.bottom:.1f}"/><text x="{self.x(value):.1f}" y="{self.bottom + 16:.1f}" '
            f'text-anchor="middle">{value:g}</text>'
            for value in self.across.round_values(step)
        )
        up = (
            f'<line x1="{_LEFT:g}" y1="{self.y(value):.1f}" x2="{self.right:.1f}" '
            f'y2="{self.y(value):.1f}"/><text x="{_LEFT - 6:g}" y="{self.y(value) + 4:.1f}" '
            f'text-anchor="end">{value:g}</text>'
            for value in self.up.round_values(step)
        )
        return "".join((*across, *up))

    def line(self, name: str, points: Sequence[tuple[float, float]]) -> str:
        """Return a line through points [mm] of the class `name`."""
        places = " ".join(f"{self.x(across):.1f},{self.y(up):.1f}" for across, up in points)
        return f'<polyline class="{name}" points="{places}"/>'


def path_views(before: Path, after: Path) -> str:
    """Return the views of two paths as HTML; empty if there is none."""
    points = [*before, *after]
    if not points:
        return ""
    ranges = [(min(values), max(values)) for values in list(zip(*points, strict=True))[:3]]
    longest = max(high - low for low, high in ranges) or 1.0
    axes = [_section(name, *of, longest) for name, of in zip("xyz", ranges, strict=True)]
    scale = (_WIDTH - _LEFT - _RIGHT) / max(one.high - one.low for one in axes)
    step = _round_step(longest / _FEWEST_LINES)
    figures = []
    for title, across, up in _VIEWS:
        view = _View(axes[across], axes[up], scale)
        lines = (
            view.line(name, [(point[across], point[up]) for point in path])
            for name, path in (("old", before), ("new", after))
        )
        label = f"{title}: {view.across.name} to the right, {view.up.name} up [mm]"
        figures.append(
            f'<figure><svg viewBox="0 0 {view.right + _RIGHT:.0f} {view.bottom + _BOTTOM:.0f}" '
            f'role="img" aria-label="{label}">{view.grid(step)}{"".join(lines)}</svg>'
            f"<figcaption>{label}</figcaption></figure>"
        )
    return f'<div class="views">{"".join(figures)}</div>'


def _section(name: str, low: float, high: float, longest: float) -> _Axis:
    """Return the section of an axis with some room around the values from `low` to `high`."""
    room = 0.03 * longest + 0.5 * max(_LEAST_SHARE * longest - (high - low), 0.0)
    return _Axis(name, low - room, high + room)


def _round_step(most: float) -> float:
    """Return the largest of 1, 2 and 5 times a power of ten that is not above `most`."""
    power: float = 10.0 ** floor(log10(most))
    return max(one * power for one in (1.0, 2.0, 5.0) if one * power <= most)
