"""Make a program that fails smaller, as long as it fails in the same place."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from fuzzing.programs import Made

_DEEPEST = 14
"""Blanks before the innermost statements."""


def shrunk(made: Made, fails: Callable[[Made], bool], attempts: int) -> Made:
    """The smallest program found that still fails.

    Files go first, then what stands at the left, then what stands in it, from the end to the
    beginning, until nothing more can go.

    Args:
        made: A program that fails.
        fails: Whether a smaller one does so in the same way.
        attempts: How often that may be asked.
    """
    left = iter(range(attempts))

    def still(candidate: Made) -> bool:
        return next(left, None) is not None and fails(candidate)

    for file in tuple(made.files):
        named = tuple(name for name in made.named if name != file)
        smaller = Made({f: t for f, t in made.files.items() if f != file}, named)
        if named and still(smaller):
            made = smaller
    before = None
    while before != made:
        before = made
        for file in made.files:
            for depth in range(2, _DEEPEST, 2):
                for at in reversed(range(len(made.files[file].splitlines()))):
                    lines = made.files[file].splitlines()
                    if at < len(lines) and _depth(lines[at]) == depth:
                        tried = (
                            made.with_text(file, "\n".join([*candidate, ""]))
                            for candidate in _without(lines, at)
                        )
                        made = next(filter(still, tried), made)
    return made


def _without(lines: list[str], at: int) -> Iterator[list[str]]:
    """The lines without those that go with one, and without what stands around these."""
    begin, end = _block(lines, at)
    yield lines[:begin] + lines[end:]
    if end - begin > 2:
        inside = [line.removeprefix("  ") for line in lines[begin + 1 : end - 1]]
        yield lines[:begin] + inside + lines[end:]


def _block(lines: list[str], at: int) -> tuple[int, int]:
    """The lines that go with a line: what is indented below it, and the end of it."""
    depth = _depth(lines[at])
    end = at + 1
    while end < len(lines) and _depth(lines[end]) > depth:
        end += 1
    if end < len(lines) and end > at + 1 and lines[end].lstrip().startswith("END"):
        end += 1
    return at, end


def _depth(line: str) -> int:
    return len(line) - len(line.lstrip())
