"""Moves that are over settle as columns; what comes of a run is the same as if they had not."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
from command_line import call
from exports import ROBOT, export

from rapidsim.controller import task_moves
from rapidsim.controller.journal import journal
from rapidsim.controller.moves import planned_segments, settled_lines
from rapidsim.controller.moves.settled_lines import SettledLines
from rapidsim.controller.queue import motion_queue, move_log
from rapidsim.jobs.checking import load_tasks
from rapidsim.motion import derived_values

_COUNT = 120
_OPEN = 30


@contextmanager
def _short_blocks(*, settle: bool) -> Iterator[list[SettledLines]]:
    """Few moves are many here; with `settle` they settle soon, and hardly a value is stored."""
    found: list[SettledLines] = []

    def settled(moves: list[object]) -> Iterator[object]:
        for part in original(moves):  # type: ignore[arg-type]
            if isinstance(part, SettledLines):
                found.append(part)
            yield part

    original = settled_lines.settled
    most = 10 if settle else 1_000_000
    with ExitStack() as stack:
        for where, name, value in (
            (load_tasks, "MOST_STATEMENTS", 10),
            (motion_queue, "MAX_OPEN_MOVES", _OPEN),
            (task_moves, "MAX_OPEN_MOVES", _OPEN),
            (motion_queue, "REMEMBERED_S", 0.05),
            (move_log, "_FEWEST", most),
            (move_log, "settled", settled),
            (journal, "_MANY_LINES", most),
            (planned_segments, "_MANY", most),
            (derived_values, "_LARGE", most),
            (derived_values, "_MOST", 20),
        ):
            stack.enter_context(patch.object(where, name, value))
        yield found


def _outputs(text: str, folder: Path, *, settle: bool) -> tuple[list[str], int]:
    """All that a run prints and writes, and the number of moves that settled."""
    folder.mkdir()
    (folder / "m.mod").write_text(text)
    (folder / "rapidsim.toml").write_text('[signals]\ndo1 = { type = "do" }\n')
    with _short_blocks(settle=settle) as found:
        ended = call(
            *("run", "m.mod", "--robot", ROBOT, "--no-record", "--format", "json"),
            *("--trace", "t.csv", "--events", "e.jsonl", "--dt", "0.1"),
            cwd=folder,
        )
    written = [(folder / name).read_text() for name in ("t.csv", "e.jsonl")]
    return [ended.out, *written], sum(map(len, found))


@pytest.mark.parametrize("form", ["inline", "mixed"])
def test_outputs_are_the_same_as_without(form: str, tmp_path: Path) -> None:
    text = export(form, "tilted", _COUNT).replace("doExtruder", "do1")
    (settled, many), (others, none) = (
        _outputs(text, tmp_path / name, settle=name == "settled") for name in ("settled", "others")
    )
    assert many > _COUNT // 2
    assert none == 0
    for one, other in zip(settled, others, strict=True):
        assert one == other.replace("/others/", "/settled/")


def test_large_derived_values_are_computed_again_and_equal() -> None:
    class Squares:
        computed = 0

        @derived_values.derived_value
        def values(self) -> np.ndarray:
            """Squares."""
            self.computed += 1
            return np.arange(5000) ** 2

    first, others = Squares(), [Squares() for _ in range(100)]
    assert first.values is first.values
    assert sum(len(one.values) for one in others) == 500_000
    assert (first.values == np.arange(5000) ** 2).all()
    assert first.computed == 2
    assert others[-1].values is others[-1].values
    assert others[-1].computed == 1
