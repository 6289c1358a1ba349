"""What holds on another machine: NumPy uses what its processor can, and rounds accordingly.

On one machine two runs are equal to the last bit. One with other vector instructions is stood for
by this one with those switched off that NumPy would choose between.
"""

import json
import math
import os
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

SAME = 2e-7
"""Of every number, in its unit: 1e-7 s, mm, degrees. `wait_s` is what is left of two times of half
a minute, each of which agrees within SHARE."""
SHARE = 1e-8
"""Of large ones, such as speeds."""
PROGRAMS = Path(__file__).parents[2] / "programs"
PROGRAMS_RUN = ("circle.mod", "pentagon.mod")


def switchable() -> str:
    """What this processor can and NumPy has code for that does without; "" where there is none."""
    try:
        core = import_module("numpy._core._multiarray_umath")
        kinds, can = core.__cpu_dispatch__, core.__cpu_features__
    except (ImportError, AttributeError):
        return ""
    return " ".join(one for one in kinds if can.get(one))


needs_a_choice = pytest.mark.skipif(
    not switchable(), reason="NumPy has one kind of code only for this machine's processor"
)


def run(program: str, folder: Path, *, without: str = "") -> tuple[str, str]:
    """The JSON and the trace of a run in a process of its own."""
    trace = folder / "trace.csv"
    environment = {**os.environ, "NPY_DISABLE_CPU_FEATURES": without}
    done = subprocess.run(
        [
            *(sys.executable, "-m", "rapidsim", "run", str(PROGRAMS / program), "--no-record"),
            *("--format", "json", "--trace", str(trace), "--home", str(folder)),
        ],
        capture_output=True,
        env=environment,
        check=False,
    )
    assert done.returncode in (0, 1), done.stderr.decode()
    return done.stdout.decode().replace(str(folder), "its folder"), trace.read_text()


@needs_a_choice
@pytest.mark.parametrize("program", PROGRAMS_RUN)
def test_another_machine_agrees_within_a_ten_millionth(program: str, tmp_path: Path) -> None:
    here, there = folders(tmp_path)
    (report, trace), elsewhere = run(program, here), run(program, there, without=switchable())
    assert_near(list(parts(json.loads(report))), list(parts(json.loads(elsewhere[0]))))
    table, other = list(cells(trace)), list(cells(elsewhere[1]))
    assert_near(table, other)
    # A tie in rounding is one in a hundred thousand numbers.
    assert sum(one != another for one, another in zip(table, other, strict=True)) <= 1


def folders(place: Path) -> tuple[Path, Path]:
    one, other = place / "one", place / "other"
    one.mkdir()
    other.mkdir()
    return one, other


def assert_near(here: list[object], elsewhere: list[object]) -> None:
    assert len(here) == len(elsewhere)
    for one, other in zip(here, elsewhere, strict=True):
        if isinstance(one, float) and isinstance(other, float):
            assert math.isclose(one, other, rel_tol=SHARE, abs_tol=SAME) or one == other
        else:
            assert one == other


def parts(value: object) -> Iterator[object]:
    """The names, texts and numbers of a JSON value."""
    if isinstance(value, dict):
        for key, part in value.items():
            yield key
            yield from parts(part)
    elif isinstance(value, list):
        for part in value:
            yield from parts(part)
    else:
        yield float(value) if isinstance(value, int) else value


def cells(table: str) -> Iterator[object]:
    """The columns and numbers of a trace."""
    for line in table.splitlines():
        for cell in line.split(","):
            try:
                yield float(cell)
            except ValueError:
                yield cell


@needs_a_choice
def test_the_switch_switches() -> None:
    """Or the test above would compare a machine with itself."""
    code = (
        "from numpy._core._multiarray_umath import __cpu_features__ as features;"
        f"print(any(features[one] for one in {switchable().split(' ')!r}))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        env={**os.environ, "NPY_DISABLE_CPU_FEATURES": switchable()},
        check=True,
    )
    assert done.stdout.decode().strip() == "False"
