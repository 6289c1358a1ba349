"""What README and docs claim of speed and size, and the bound that holds for each.

`claims.py` measures all of it in one run, peers included; a test holds that no page says more.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Stated:
    """A claim."""

    what: str
    unit: str
    most: float | None = None
    least: float | None = None
    pages: tuple[tuple[str, str], ...] = ()
    """Where it stands, and in which words; none for what only this file promises."""

    def holds(self, value: float) -> bool:
        """Whether a number is within the bounds."""
        return (self.most is None or value <= self.most) and (
            self.least is None or value >= self.least
        )

    @property
    def bound(self) -> str:
        """The bounds in words."""
        parts = (("at least", self.least), ("at most", self.most))
        return " and ".join(f"{word} {number:g}" for word, number in parts if number is not None)


_NUMPY = "x as long as `import numpy, lark, click`"
STATED = (
    Stated("check of a tiny module, the first time", _NUMPY, most=1.5),
    Stated("check of a tiny module, the second time", _NUMPY, most=1.5),
    Stated(
        "check of 100 small modules, the second time",
        "of the first time",
        most=0.2,
        pages=(
            ("docs/ci.md", "100 small modules take a fifth of the time"),
            ("CHANGELOG.md", "100 small modules take a fifth of the time"),
        ),
    ),
    Stated(
        "check of 100,000 moves, the second time",
        "of the first time",
        most=0.12,
        pages=(
            ("docs/ci.md", "an export of 100,000 moves a tenth"),
            ("CHANGELOG.md", "100,000 moves a tenth"),
        ),
    ),
    Stated(
        "start of a second process",
        "s",
        most=0.5,
        pages=(("docs/ci.md", "A process takes a third of a second to start"),),
    ),
    Stated("an hour of pick and place", "s of processor", most=25.0),
    Stated("  memory a virtual minute", "MB", most=0.2),
    Stated("ten minutes of polling", "s of processor", most=5.0),
    Stated("reach of 100,000 places of ten targets", "s of processor", most=20.0),
    Stated(
        "  targets",
        "a second",
        least=100_000.0,
        pages=(("docs/sweep.md", "some hundred thousand targets per second"),),
    ),
    Stated(
        "loops of RAPID beside Python, geometric mean",
        "x as long",
        most=2.3,
        pages=(("docs/simulated.md", "about two to three times slower than Python"),),
    ),
    Stated(
        "  the worst of them",
        "x as long",
        most=4.0,
        pages=(("docs/simulated.md", "about two to three times slower than Python"),),
    ),
    Stated(
        "a check of 24 KB beside rapidchecker",
        "x as fast, without start",
        least=100.0,
        pages=(("README.md", "30 times as fast; without process start-up 100 to 300 times"),),
    ),
    Stated(
        "time-optimal planning beside toppra",
        "x as fast",
        least=4.0,
        pages=(
            ("README.md", "| time-optimal planning, the same rows and grid | 5 times as fast |"),
            ("docs/timing.md", "found 5 times as fast"),
        ),
    ),
    Stated(
        "  durations differ by",
        "of them",
        most=1e-5,
        pages=(("README.md", "equal to 3e-6"),),
    ),
    Stated(
        "planning 10,000 moves with numba beside NumPy",
        "x as fast",
        least=1.2,
        pages=(("docs/install.md", "planned a third faster"),),
    ),
    Stated(
        "moves of 2 mm planned, in NumPy",
        "a second",
        least=5_000.0,
        pages=(("docs/timing.md", "| moves of 2 mm with z1 planned per second | at least 5,000"),),
    ),
    Stated(
        "moves of 2 mm planned, with numba",
        "a second",
        least=30_000.0,
        pages=(("docs/timing.md", "| moves of 2 mm with z1 planned per second | at least 5,000"),),
    ),
    Stated(
        "installed size of the core",
        "MB",
        most=95.0,
        pages=(
            (
                "README.md",
                "| installed size of the core, which checks and runs | 94 MB, with",
            ),
            ("docs/install.md", "The core takes 94 MB"),
        ),
    ),
    Stated(
        "recording of an hour under way",
        "MB",
        most=100.0,
        pages=(("docs/recording.md", "stays under 100 MB"),),
    ),
    Stated(
        "report of 10,000 moves",
        "MB",
        most=2.5,
        pages=(("docs/recording.md", "A path of 10,000 moves takes 2 MB"),),
    ),
)
