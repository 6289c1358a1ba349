"""`rapidsim diff`: times, outputs, saved runs, and what the command prints."""

import json
import random
from pathlib import Path

import pytest
from command_line import Ended, call
from laws import cases
from test_comparison_mutations import MAIN, POINTS, folder


@pytest.fixture
def sides(tmp_path: Path) -> Path:
    folder(tmp_path / "old", MAIN, POINTS)
    slower = MAIN.replace("WaitTime 0.2", "WaitTime 0.5").replace("doLamp", "doHorn")
    folder(tmp_path / "new", slower, POINTS)
    return tmp_path


def diff(place: Path, *arguments: str) -> Ended:
    return call("diff", *arguments, "--robot", "irb1600", cwd=place)


def test_times_and_outputs_are_told(sides: Path) -> None:
    ended = diff(sides, "old", "new")
    assert ended.code == 1
    for line in (
        "  argument in pick: WaitTime: 0.2 -> 0.5 (Main.mod:22)",
        "  signal in place: SetDO: doLamp -> doHorn (Main.mod:33)",
        "  pick: WaitTime 0.2 s: 0.400 s -> not run (-0.400 s)",
        "  pick: WaitTime 0.5 s: not run -> 1.000 s (+1.000 s)",
        "  doHorn: set once instead of never",
        "  doLamp: set never instead of once",
    ):
        assert line in ended.out.splitlines()
    assert "(+0.600 s)" in ended.out
    assert "doGrip: becomes 0 0.300 s later" in ended.out
    assert "new  warning[I801] the signal `doHorn` is not declared" in ended.out
    assert {one.name for one in sides.iterdir()} == {"old", "new"}


def test_other_forms_say_the_same(sides: Path) -> None:
    report = json.loads(diff(sides, "old", "new", "--format", "json").out)
    assert report["same"] is False
    assert [one["kind"] for one in report["changes"]] == ["argument", "signal"]
    assert report["run"]["after_s"] - report["run"]["before_s"] == pytest.approx(0.6, abs=0.001)
    marked = diff(sides, "old", "new", "--format", "markdown").out
    assert marked.startswith("### old → new\n")
    assert "- signal in place: SetDO: doLamp -&gt; doHorn" in marked.replace("->", "-&gt;")
    assert "\n| | before | after | change |\n|---|--:|--:|--:|\n| all | " in marked
    ended = diff(sides, "old", "new", "--format", "html", "--output", "diff.html")
    assert (ended.code, ended.out) == (1, "")
    page = (sides / "diff.html").read_text(encoding="utf-8")
    assert page.count("<polyline") == 4
    assert "`" not in page
    assert "<tr><th></th><th>before</th><th>after</th><th>change</th></tr>" in page
    assert "doLamp -&gt; doHorn" in page
    refused = diff(sides, "old", "new", "--format", "html")
    assert (refused.code, "--output FILE.html" in refused.err) == (2, True)


def test_a_saved_run_is_compared_with_a_program(sides: Path) -> None:
    options = ("--robot", "irb1600", "--no-record", "--format", "json")
    (sides / "old.json").write_text(call("run", "old", *options, cwd=sides).out)
    same = diff(sides, "old.json", "old")
    assert (same.code, same.out) == (0, "No difference.\n")
    assert "doHorn: set once instead of never" in diff(sides, "old.json", "new").out
    assert diff(sides, "old.json", "old", "--no-run").code == 2
    saved = json.loads((sides / "old.json").read_text())
    saved["models"]["motion"] = "1"
    saved["time_s"] += 1.0
    (sides / "older.json").write_text(json.dumps(saved))
    told = diff(sides, "older.json", "new").out
    assert "times of motion model 1 are compared with those of 3" in told
    (sides / "wrong.json").write_text("[1]")
    refused = diff(sides, "wrong.json", "old")
    assert (refused.code, "wrong.json is not a saved run" in refused.err) == (2, True)
    assert diff(sides, "old", "nowhere").code == 2


def test_a_program_with_errors_is_compared_by_its_text(sides: Path) -> None:
    module = sides / "new" / "Main.mod"
    module.write_text(module.read_text().replace("place i;", "place unknown;"))
    ended = diff(sides, "old", "new")
    assert ended.code == 1
    assert "argument in main: place: i -> unknown (Main.mod:13)" in ended.out
    assert "new  error[N201] `unknown` is not declared (Main.mod:13)" in ended.out
    assert "No times: new does not run: `unknown` is not declared." in ended.out


def test_another_arm_and_an_error_are_told_first(sides: Path) -> None:
    program = (sides / "new" / "Main.mod").read_text()
    (sides / "new" / "Main.mod").write_text(program.replace("place i;", "place i/(i-i);"))
    for side, arm in (("old", "irb1600"), ("new", "irb1600-8-1.45")):
        (sides / side / "rapidsim.toml").write_text(f'[robot]\nmodel = "{arm}"\n')
    told = call("diff", "old", "new", cwd=sides).out
    assert told.startswith(
        'Configuration\n  station: `robot`, model: "irb1600" -> "irb1600-8-1.45"\n\nProgram\n'
    )
    assert "End of the run\n  ended -> error (R101: " in told
    report = json.loads(call("diff", "old", "new", "--format", "json", cwd=sides).out)
    assert report["run"]["robots"] == ["irb1600-6-1.2", "irb1600-8-1.45"]
    assert report["run"]["errors"][0] is None


WRONG = (
    ("moves", None, "moves is missing"),
    ("moves", [1], "moves[0] is not an object"),
    ("moves", [{"task": "T_ROB1"}], "moves[0].instruction is missing"),
    ("time_s", "2", "time_s is not a number"),
    ("time_s", 10**400, "time_s is not a finite number"),
    ("end", "over", "end is `over`, and not one of ended, stopped"),
    ("events", [{"kind": "signal", "signal": 3}], "events[0].signal is not text"),
    ("waits", 5, "waits is not a list"),
    ("models", [2], "models is not an object"),
    ("diagnostics", [{"severity": "error", "code": 5}], "diagnostics[0].code is not text"),
)


@pytest.mark.parametrize(("key", "value", "said"), WRONG)
def test_a_saved_run_that_is_wrong_is_refused(
    key: str, value: object, said: str, tmp_path: Path
) -> None:
    run = {"time_s": 1.0, "end": "ended", "moves": [], "events": []}
    (tmp_path / "good.json").write_text(json.dumps(run))
    (tmp_path / "bad.json").write_text(json.dumps({**run, key: value}))
    assert call("diff", "good.json", "good.json", cwd=tmp_path).code == 0
    ended = call("diff", "good.json", "bad.json", cwd=tmp_path)
    assert (ended.code, said in ended.err.replace("\n", " ")) == (2, True)


def test_a_damaged_saved_run_never_ends_in_a_defect(sides: Path) -> None:
    options = ("--robot", "irb1600", "--no-record", "--format", "json")
    data = call("run", "old", *options, cwd=sides).out.encode()
    (sides / "old.json").write_bytes(data)
    random_ = random.Random(5)
    numbers = ("null", "[]", "{}", "-1", "1e999", "true", '"x"', "[[" * 5000)
    for number in range(cases(1500)):
        if random_.random() < 0.5:
            damaged = bytearray(data)
            for _ in range(random_.randint(1, 5)):
                damaged[random_.randrange(len(damaged))] = random_.choice(b'[]{},:"0e-.x\xff')
        else:
            lines = data.decode().split("\n")
            at = random_.randrange(len(lines))
            key, colon, _ = lines[at].partition(": ")
            lines[at] = f"{key}{colon}{random_.choice(numbers)},"
            damaged = bytearray("\n".join(lines).encode())
        (sides / "new.json").write_bytes(damaged)
        ended = call("diff", "old.json", "new.json", cwd=sides)
        assert ended.code in (0, 1, 2), (number, ended.err)
