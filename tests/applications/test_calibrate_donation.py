"""A donated file contains joints, times and moves, nothing else, and is read back as a log."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from command_line import call

from rapidsim.applications.calibrate.donation import read_donation
from rapidsim.files import InputError

HELP_US = Path(__file__).parents[2] / "docs" / "help-us.md"
PROGRAM = r"""MODULE secret
  ! Confidential: the customer's name
  PERS tooldata tSecret:=[TRUE,[[20,0,100],[0.96592583,0,0.25881905,0]],
    [2,[0,0,50],[1,0,0,0],0,0,0]];
  CONST robtarget pSecret:=[[600,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ pSecret, v1000, fine, tSecret;
    WaitTime 0.3;
    AccSet 80, 50 \FinePointRamp:=50;
    MoveL Offs(pSecret, 0, 60, 0), v500, z10, tSecret;
    MoveL Offs(pSecret, 60, 60, 0), v500, z5, tSecret;
    MoveC Offs(pSecret, 100, 100, 0), Offs(pSecret, 60, 140, 0), v300, z10, tSecret;
    MoveL Offs(pSecret, 0, 140, 0), v500\T:=0.4, fine, tSecret;
    {last}
  ENDPROC
ENDMODULE
"""


def logged(folder: Path, last: str = "") -> Path:
    """A log of the program by another motion model."""
    module = folder / "secret.mod"
    module.write_text(PROGRAM.replace("{last}", last))
    (folder / "slow.toml").write_text("[motion]\nfine_dwell = 0.15\n")
    log = folder / "secret.csv"
    made = call(
        *("run", module, "--station", folder / "slow.toml", "--no-record", "--robot", "irb1600"),
        *("--trace", log, "--dt", "0.012"),
        cwd=folder,
    )
    assert made.code == 0, made.err
    return log


def keys_of(value: object) -> Iterator[str]:
    if isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield from keys_of(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from keys_of(inner)


def texts_of(value: object) -> Iterator[str]:
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for inner in value:
            yield from texts_of(inner)
    elif isinstance(value, str):
        yield value


def test_a_donated_file_has_what_the_page_lists_and_gives_the_same_fit(tmp_path: Path) -> None:
    log = logged(tmp_path)
    file = tmp_path / "log.json"
    asked = ("--robot", "irb1600", "--format", "json")
    told = call("calibrate", log, "--donate", file, "--robotware", "6.15.01", *asked, cwd=tmp_path)
    assert told.code == 0, told.err
    donated = json.loads(file.read_text())
    rows = (line for line in HELP_US.read_text().splitlines() if line.startswith("| `"))
    listed = {name for row in rows for name in re.findall(r"`(\w+)`", row.split("|")[1])}
    assert set(keys_of(donated)) <= listed
    assert set(texts_of(donated)) == {"irb1600-6-1.2", "6.15", "joint", "line", "arc"}
    again = call("calibrate", file, "--format", "json", cwd=tmp_path)
    assert again.code == 0, again.err
    first, second = json.loads(told.out), json.loads(again.out)
    assert second["logs"][0]["name"] == "log.json 1"
    for one, other in zip(first["parameters"], second["parameters"], strict=True):
        assert other["value"] == pytest.approx(one["value"], abs=0.05 * one["uncertainty"])


def test_settings_that_moves_do_not_show_are_refused(tmp_path: Path) -> None:
    last = r"PathAccLim TRUE\AccMax:=0.5, TRUE\DecelMax:=0.5; MoveJ pSecret, v1000, fine, tSecret;"
    log = logged(tmp_path, last)
    told = call("calibrate", log, "--robot", "irb1600", "--donate", "log.json", cwd=tmp_path)
    assert (told.code, "alone do not repeat its run" in told.err) == (2, True)
    assert not (tmp_path / "log.json").exists()


def test_a_place_that_cannot_be_written_is_refused_before_the_fit(tmp_path: Path) -> None:
    (tmp_path / "here.json").write_text("{}")
    asked = ("calibrate", "no_such_log.csv", "--robot", "irb1600", "--donate")
    for name, why in (
        ("here.json", "is here already"),
        ("nowhere/log.json", "nowhere is not a folder"),
        ("log.txt", "must end in .json"),
    ):
        told = call(*asked, name, cwd=tmp_path)
        assert (told.code, why in told.err) == (2, True), told.err
    assert (tmp_path / "here.json").read_text() == "{}"


MOVE = {
    "path": "joint",
    "wait_s": 0.0,
    "joints_deg": [0.0] * 6,
    "base_from_tcp": [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    "circle_point": None,
    "flange_from_tcp": [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    "load_kg": 0.0,
    "speed": [100.0, 500.0],
    "zone": None,
    "duration_s": None,
    "acceleration_percent": 100.0,
    "ramp_percent": 100.0,
    "stop_ramp_percent": 100.0,
}


@pytest.mark.parametrize(
    ("times", "move", "message"),
    [
        ([0.0, 1.0], {"path": "joint; Break"}, "move 1 has impossible values"),
        ([0.0, 1.0], {"zone": [1.0]}, "has 1 items in place of 3"),
        ([0.0, 1.0], {"speed": [1e9, 1.0]}, "move 1 has impossible values"),
        ([0.0, 1.0], {"joints_deg": [0.0]}, "not all rows have 6 axes"),
        ([1.0, 0.0], {}, "the times do not ascend"),
        ([0.0], {}, "as many times as rows"),
    ],
)
def test_impossible_values_are_refused(
    tmp_path: Path, times: list[float], move: dict[str, object], message: str
) -> None:
    run = {"times_s": times, "joints_deg": [[0.0] * 6] * 2, "moves": [MOVE | move]}
    file = tmp_path / "log.json"
    file.write_text(json.dumps({"arm": "irb1600-6-1.2", "robotware": None, "runs": [run]}))
    told = call("calibrate", file, cwd=tmp_path)
    assert (told.code, message in told.err) == (2, True), told.err


@pytest.mark.parametrize("text", ["", "[]", "{", '{"arm": 3}', '{"arm": "irb120"}', "[" * 100_000])
def test_other_files_are_refused(tmp_path: Path, text: str) -> None:
    file = tmp_path / "log.json"
    file.write_text(text)
    with pytest.raises(InputError, match="is no file of"):
        read_donation(file)


def test_logs_of_two_arms_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "log.json"
    file.write_text('{"arm": "irb1600-6-1.2", "robotware": null, "runs": []}')
    told = call("calibrate", file, "--robot", "irb120", cwd=tmp_path)
    assert (told.code, "not of one arm" in told.err) == (2, True)
