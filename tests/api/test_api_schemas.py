"""What is printed as JSON is what the published schemas say, key by key."""

import json
from pathlib import Path
from typing import Any

import pytest
from command_line import call
from jsonschema import Draft202012Validator

import rapidsim
from rapidsim.shipped import shipped

ROOT = Path(__file__).parents[2]
PROGRAMS = ROOT / "programs"
HERE = Path(__file__).parent / "programs"
ROBOT = ("--robot", "irb120")
TURN = ("--quaternion", "0.7071068,0,0.7071068,0")
BROKEN = "MODULE m\nPROC main()\nn:=1;\nFOO x;\nIF n=1 THEN\nENDPROC\nENDMODULE\n"
FIXABLE = "MODULE fixable\nPROC main()\nVAR num n;\nn=1;\nENDPROC\nENDMODULE\n"
FAILS = """MODULE m
  PROC main()
    inverse 0;
  ENDPROC
  PROC inverse(num a)
    a:=1/a;
  ENDPROC
ENDMODULE
"""
LOGGED = """MODULE short
  CONST robtarget a:=[[600,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a, v500, fine, tool0;
    MoveL Offs(a, 0, 30, 0), v200, fine, tool0;
  ENDPROC
ENDMODULE
"""
NAMES = sorted(file.stem for file in shipped("schemas").glob("*.json"))

ASSERTED = ("--assert", "time_s < 1", "--assert", "moves = 14")
CALLS: dict[str, tuple[tuple[object, ...], ...]] = {
    "run": (
        ("run", HERE / "waits.mod", "--trace", "x.csv", "--report", "x.html", "--no-record"),
        (
            "run",
            PROGRAMS / "cell",
            "--record",
            "x.rrd",
            "--assert",
            "time_s<1",
            "--assert",
            "moves=14",
        ),
        ("run", PROGRAMS / "multimove", "--no-record"),
        ("run", PROGRAMS / "out_of_reach.mod", "--no-record", "--assert", "time_s < 1"),
        ("run", "broken.mod", "--no-record"),
        ("run", "fails.mod", "--no-record"),
        ("run", "fixable.mod", "--no-record"),
    ),
    "check": (
        ("check", PROGRAMS / "out_of_reach.mod"),
        ("check", PROGRAMS / "cell"),
        ("check", "broken.mod", "fixable.mod", "--statistics"),
        ("check", "fixable.mod", "--fix", "--diff"),
    ),
    "kin-fk": (("kin", "fk", *ROBOT, "--joints", "0,0,0,0,30,0"),),
    "kin-ik": (
        ("kin", "ik", *ROBOT, "--position", "374,0,630", *TURN, "--all"),
        ("kin", "ik", *ROBOT, "--position", "1374,0,630", *TURN),
        ("kin", "ik", *ROBOT, "--position", "374,0,630", *TURN, "--solver", "lm"),
    ),
    "kin-jacobian": (
        ("kin", "jacobian", *ROBOT, "--joints", "0,0,0,0,0,0"),
        ("kin", "jacobian", *ROBOT, "--joints", "0,0,0,0,0,0", "--twist", "1,2,3,4,5,6"),
    ),
    "robots": (("robots",),),
    "robots-for": (
        ("robots", "--for", PROGRAMS / "cell"),
        ("robots", "--for", "missing.mod"),
    ),
    "robot": (
        ("robots", "irb120", "--table", "--workspace", "--cycle"),
        ("robots", "rvm1"),
        ("robots", "irb460", "--table"),
        ("robots", ROOT / "robots" / "irb120-3-0.58" / "irb120-3-0.58.urdf"),
    ),
    "frames": (("frames", PROGRAMS / "cell"),),
    "follow": (
        ("follow", PROGRAMS / "rvm1_line.csv", "--robot", "rvm1"),
        ("follow", PROGRAMS / "rvm1_line.csv", "--robot", "rvm1", "--skip-unreachable"),
        ("follow", PROGRAMS / "kr10_row.csv", "--robot", "kr10"),
    ),
    "follow-compare": (("follow", PROGRAMS / "kr10_row.csv", "--robot", "kr10", "--compare"),),
    "calibrate": (("calibrate", "short.csv"),),
    "protocol": (("protocol", "answers.txt"),),
    "error": (("run", "missing.mod"), ("robots", "irb121"), ("check", "--selct", "K6")),
    "diff": (
        ("diff", "short.mod", "moved.mod", "--robot", "irb1600"),
        ("diff", "short.mod", "short.mod", "--no-run"),
        ("diff", "short.mod", "broken.mod"),
    ),
}


def unknown_keys(value: Any, schema: Any, whole: Any, place: str = "") -> list[str]:
    """Keys that no schema lists, where it does not say that there may be others."""
    if "anyOf" in schema:
        schema = next(one for one in schema["anyOf"] if one != {"type": "null"})
    if "$ref" in schema:
        schema = whole["$defs"][schema["$ref"].rpartition("/")[2]]
    match value:
        case dict():
            listed = schema.get("properties", {})
            more = schema.get("additionalProperties", False)
            found = [f"{place}.{key}" for key in value if key not in listed and not more]
            for key in value.keys() & listed.keys():
                found += unknown_keys(value[key], listed[key], whole, f"{place}.{key}")
            return found
        case list() if "items" in schema:
            return [
                found
                for item in value
                for found in unknown_keys(item, schema["items"], whole, f"{place}[]")
            ]
        case _:
            return []


@pytest.mark.parametrize("name", NAMES)
def test_output_is_as_its_schema_says(name: str, tmp_path: Path) -> None:
    (tmp_path / "broken.mod").write_text(BROKEN)
    (tmp_path / "fails.mod").write_text(FAILS)
    (tmp_path / "fixable.mod").write_text(FIXABLE)
    (tmp_path / "short.mod").write_text(LOGGED)
    (tmp_path / "answers.txt").write_text("questions;1\nrobotware;7.13\n1;3\n")
    (tmp_path / "moved.mod").write_text(LOGGED.replace("0, 30, 0), v200", "0, 40, 0), v200"))
    if name == "calibrate":
        call(
            "run", "short.mod", "--no-record", "--trace", "short.csv", "--dt", "0.008", cwd=tmp_path
        )
    schema = rapidsim.json_schema(name)
    Draft202012Validator.check_schema(schema)
    for arguments in CALLS[name]:
        ended = call(*arguments, "--format", "json", cwd=tmp_path)
        printed = json.loads(ended.out)
        Draft202012Validator(schema).validate(printed)
        assert not unknown_keys(printed, schema, schema)


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (("run", "fixable.mod", "--no-record"), '"fix": {'),
        (CALLS["kin-jacobian"][1], '"missed": {'),
        (CALLS["robots-for"][1], '"error": {'),
        (CALLS["robot"][-1], '"maker": null'),
        (CALLS["robot"][-1], '"reach_mm": null'),
        (CALLS["follow"][1], '"limit_deg_s": null'),
    ],
)
def test_the_calls_print_rare_values(
    arguments: tuple[object, ...], text: str, tmp_path: Path
) -> None:
    (tmp_path / "fixable.mod").write_text(FIXABLE)
    assert text in call(*arguments, "--format", "json", cwd=tmp_path).out


def test_the_description_of_a_key_is_its_own() -> None:
    files = rapidsim.json_schema("check")["properties"]["files"]
    assert files == {"type": "integer", "description": "Number of files that were read."}


def test_a_schema_that_is_none_is_refused() -> None:
    with pytest.raises(rapidsim.InputError, match="no schema `runs`") as raised:
        rapidsim.json_schema("runs")
    assert raised.value.help == "did you mean `run`?"
