"""Programs that nobody would write: every command ends with an exit code that a page promises.

In `generated/` stand the smallest programs that failed once, as `benchmarks/fuzz.py` left them; the
others are a few of those it makes, the same in every run. What all of them get, one in many gets
with pictures, a recording and a report: 50 is among the first.
"""

from pathlib import Path

import pytest
from fuzzing import campaign
from fuzzing.campaign import Tally, program, try_program
from fuzzing.dice import Dice
from fuzzing.laws import LAWS
from fuzzing.sending import send
from fuzzing.shrinking import shrunk
from laws import cases

from rapidsim.plots import write
from rapidsim.plots.path_picture import path_picture
from rapidsim.reach import reach

GENERATED = Path(__file__).parent / "generated"
FAILED_ONCE = sorted(path for path in GENERATED.iterdir() if path.is_dir() or path.suffix == ".mod")
SEED = 13
FIRST = 54
AT_ONCE = 9
SECONDS = 5.0


@pytest.mark.parametrize("path", FAILED_ONCE, ids=lambda path: path.stem)
@pytest.mark.parametrize(
    "command",
    [
        ("check",),
        ("run", "--no-record", "--max-time", "30"),
        ("run", "--no-record", "--max-time", "1e-9"),
    ],
    ids=" ".join,
)
def test_what_failed_once(path: Path, command: tuple[str, ...], tmp_path: Path) -> None:
    name, *options = command
    home = ("--home", tmp_path) if name == "run" else ()
    modules = sorted(path.glob("*.mod")) if path.is_dir() else [path]
    _, failure = send(name, *modules, *options, *home, "-v")
    assert failure is None, failure.text


@pytest.mark.parametrize("name", ["endless_move", "fails_behind_an_endless_move"])
def test_a_trace_ends_with_the_run(name: str, tmp_path: Path) -> None:
    trace = tmp_path / "t.csv"
    move = GENERATED / f"{name}.mod"
    send("run", move, "--no-record", "--max-time", "5", "--trace", trace, "--home", tmp_path)
    last, *_ = trace.read_text(encoding="utf-8").splitlines()[-1].split(",")
    # The arm comes to rest after the end.
    assert float(last) < 6.0


@pytest.mark.parametrize("first", range(FIRST, FIRST + cases(45), AT_ONCE))
def test_a_sample_of_programs(first: int, monkeypatch: pytest.MonkeyPatch) -> None:
    # All pictures would take as long as ten programs.
    monkeypatch.setattr(write, "PICTURES", {"path": path_picture})
    # Of a program that goes on for ever a check would look at two minutes, a run at half of one.
    monkeypatch.setattr(reach, "LONGEST_RUN_S", SECONDS)
    monkeypatch.setattr(campaign, "MAX_TIME", SECONDS)
    tally = Tally()
    for number in range(first, first + AT_ONCE):
        try_program(SEED, number, tally)
    assert not tally.failures
    assert tally.accepted >= tally.programs / 3


def test_a_program_follows_from_its_number() -> None:
    assert program(SEED, 3) == program(SEED, 3)
    assert program(SEED, 3) != program(SEED, 4)


def test_laws_find_programs_to_speak_of() -> None:
    for law in LAWS:
        programs = (program(SEED, number) for number in range(40))
        assert any(law.programs(one, Dice(law.name)) is not None for one in programs), law.name


def test_shrinking_keeps_what_fails() -> None:
    made = program(SEED, 3)
    small = shrunk(made, lambda one: any("PROC main" in text for text in one.files.values()), 500)
    (text,) = small.files.values()
    # The head of main; the line that ends it may go.
    assert [line.strip() for line in text.splitlines() if "PROC main" in line] == ["PROC main()"]
    assert len(text.splitlines()) <= 5
