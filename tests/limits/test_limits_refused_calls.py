"""One error at each call of a command that reads or writes; `benchmarks/fuzz.py system` tries all.

A sample: of some commands, each so many-th place that calls the system.
"""

import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from fuzzing.injections import Injections
from laws import PROFILE

from rapidsim.export import trace


@pytest.fixture(autouse=True)
def without_kept_results(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RAPIDSIM_NO_CACHE", "1")


@pytest.fixture(autouse=True)
def weak_proxy_of_nothing() -> Iterator[None]:
    """Something that other tests may leave behind, and that has no class to ask for."""
    proxy = weakref.proxy(set[str]())
    yield
    del proxy


@pytest.mark.parametrize(
    ("name", "every"),
    [
        ("check", 12),
        ("check with a baseline", 31),
        ("fmt", 2),
        ("run", 23),
        ("run as json", 37),
        ("run --write-pers", 29),
        ("init", 9),
        ("diff", 61),
        ("explain", 3),
    ],
)
def test_a_call_that_the_system_refuses(name: str, every: int) -> None:
    done = Injections(name, every if PROFILE == "fast" else 1).run()
    assert done.tried >= 4
    assert not done.broken


def test_a_half_written_file_breaks_the_law(monkeypatch: pytest.MonkeyPatch) -> None:
    @contextmanager
    def careless(path: Path) -> Iterator[Path]:
        yield path

    monkeypatch.setattr(trace, "whole_file", careless)
    done = Injections("run", only=("write",)).run()
    assert {one.reason for one in done.broken} == {"t.csv is not whole"}
