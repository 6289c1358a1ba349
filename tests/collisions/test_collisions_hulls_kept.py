"""Bodies around meshes that are kept: to the last bit those computed, and of no other content."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from castings import ring, write_stl
from command_line import call

from rapidsim.collisions import outer_hull as hulls
from rapidsim.collisions import shape
from rapidsim.collisions.convex import ConvexPart
from rapidsim.collisions.outer_hull import HullStore, outer_hull
from rapidsim.collisions.shape import Filling
from rapidsim.frames.transform import Array
from rapidsim.jobs.cache.number_store import NumberStore
from rapidsim.jobs.cache.result_store import ResultStore

RING = shape.of_mesh(ring(5200), Filling.SURFACE)
OTHER = shape.of_mesh(ring(5400), Filling.SURFACE)
CELL = """[robot]
model = "irb1600-6-1.2"
[[object]]
name = "ring"
mesh = "ring.stl"
unit = "m"
pose = { position = [700, 400, 700] }
"""
MODULE = """MODULE job
  PROC main()
    MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
  ENDPROC
ENDMODULE
"""


@pytest.fixture
def store(tmp_path: Path) -> NumberStore:
    return NumberStore(ResultStore(tmp_path / "kept"))


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Numbers of points of the bodies that were computed."""
    counts: list[int] = []
    compute = hulls._around_many

    def counted(points: Array) -> ConvexPart:
        counts.append(len(points))
        return compute(points)

    monkeypatch.setattr(hulls, "_around_many", counted)
    return counts


def around(body: shape.Shape, store: HullStore | None) -> tuple[bytes, float]:
    hulls._around.cache_clear()  # What a process keeps for itself.
    found = outer_hull(body, store)
    return found.points.tobytes(), found.radius


def test_a_body_that_is_kept_equals_the_one_computed(store: NumberStore, made: list[int]) -> None:
    plain = around(RING, None)
    assert [around(RING, store) for _ in range(3)] == 3 * [plain]
    assert len(made) == 2
    assert around(OTHER, store) == around(OTHER, None) != plain


@pytest.mark.parametrize("damage", ["cut", "bit", "empty", "digest", "shape"])
def test_a_damaged_entry_counts_as_missing(
    store: NumberStore, made: list[int], damage: str
) -> None:
    plain = around(RING, store)
    (file,) = store.store.folder.glob("*.bin")
    data = bytearray(file.read_bytes())
    match damage:
        case "cut":
            file.write_bytes(data[:-8])
        case "bit":
            data[len(data) // 2] ^= 1
            file.write_bytes(data)
        case "empty":
            file.write_bytes(b"")
        case "digest":
            data[0] ^= 1
            file.write_bytes(data)
        case _:
            store.keep_numbers(np.concatenate([RING.vertices]).tobytes(), np.zeros(5))
    assert around(RING, store) == plain
    assert around(RING, store) == plain
    assert len(made) == 2


def test_a_folder_that_cannot_be_written_keeps_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    store = NumberStore(ResultStore(tmp_path / "file"))
    assert around(RING, store) == around(RING, None)


def test_a_run_keeps_bodies_unless_it_is_not_to(tmp_path: Path, made: list[int]) -> None:
    kept, cell = tmp_path / "kept", tmp_path / "cell"
    cell.mkdir()
    (cell / "job.mod").write_text(MODULE)
    (cell / "rapidsim.toml").write_text(CELL)

    def run(triangles: int, *options: str, no_cache: str = "") -> str:
        write_stl(cell / "ring.stl", ring(triangles))
        hulls._around.cache_clear()
        variables = {"RAPIDSIM_NO_CACHE": no_cache, "RAPIDSIM_CACHE_DIR": str(kept)}
        asked = ("run", "job.mod", "--format", "json", "--no-record", *options)
        return call(*asked, cwd=cell, environment=variables).out

    plain = run(5200, "--no-cache")
    assert run(5200, no_cache="1") == plain
    assert not kept.exists()
    assert '"clearance_mm": null' not in plain
    cold = len(made)
    assert [run(5200), run(5200)] == [plain, plain]
    assert len(made) == cold + cold // 2
    other = run(5400)  # The name is the same, the content is not.
    assert other == run(5400, "--no-cache")
