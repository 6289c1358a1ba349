"""`rapidsim run --profile`: the interpreter's time by RAPID routine."""

import json
import pstats
import re
from pathlib import Path
from time import process_time

from cli_helper import rapidsim

CELL = """MODULE cell
  PROC main()
    FOR i FROM 1 TO 3 DO
      Weld_Seam i;
    ENDFOR
    spare12;
  ENDPROC

  PROC Weld_Seam(num n)
    n := n / (n - 1);
  ERROR
    n := 2;
    RETRY;
  ENDPROC
"""
SPARE = "  PROC spare{0}()\n    {1}\n  ENDPROC\n"


def cell() -> str:
    called = "".join(SPARE.format(n, f"spare{n - 1};" if n else ";") for n in range(13))
    return f"{CELL}{called}ENDMODULE\n"


def test_the_costs_are_printed_and_written_by_routine(tmp_path: Path) -> None:
    (tmp_path / "cell.mod").write_text(cell())
    ended = rapidsim("run", "cell.mod", "--no-record", "--profile", "cell.prof", cwd=tmp_path)
    assert (ended.code, ended.err) == (0, "")
    assert "Written: cell.prof (profile)" in ended.out
    title, table = ended.out.split("Wall time of the interpreter by routine ")[1].split("\n", 1)
    assert title == "(the computer's time, not the robot's):"
    headings, *rows = (line.split() for line in table.splitlines())
    assert headings == ["calls", "own", "ms", "total", "ms", "routine", "header"]
    assert len(rows) == 10
    assert [rows[0][0], *rows[0][3:]] == ["1", "main", "cell.mod:2"]
    totals = [float(row[2]) for row in rows]
    assert totals == sorted(totals, reverse=True)

    stats = pstats.Stats(str(tmp_path / "cell.prof")).stats  # type: ignore[attr-defined]
    calls = {name: numbers[1] for (file, _, name), numbers in stats.items() if file == "cell.mod"}
    assert calls.pop("<module>") == 1, "loading"
    clause = {"Weld_Seam": 3, "Weld_Seam ERROR": 1}
    assert calls == {"main": 1, **clause, **{f"spare{n}": 1 for n in range(13)}}
    callers = stats["cell.mod", 9, "Weld_Seam"][4]
    assert ("cell.mod", 2, "main") in callers


def test_the_run_is_the_same_with_it(tmp_path: Path) -> None:
    (tmp_path / "cell.mod").write_text(cell())
    run = ("run", "cell.mod", "--no-record", "--format", "json")
    plain = json.loads(rapidsim(*run, cwd=tmp_path).out)
    measured = json.loads(rapidsim(*run, "--profile", "cell.prof", cwd=tmp_path).out)
    assert measured["files"].pop("profile") == "cell.prof"
    assert measured == plain


def test_wrong_use_is_refused(tmp_path: Path) -> None:
    (tmp_path / "cell.mod").write_text(cell())
    run = ("run", "cell.mod", "--no-record", "--profile")
    assert "must end in .prof" in rapidsim(*run, "cell.txt", cwd=tmp_path).err
    both = rapidsim(*run, "cell.prof", "--break", "cell.mod:3", cwd=tmp_path)
    assert (both.code, both.err) == (2, "error: --break and --profile exclude each other\n")


def test_timings_divide_the_processor_time_and_are_there_on_request_only(tmp_path: Path) -> None:
    move = "MoveAbsJ [[{},0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;"
    body = "\n".join(move.format(angle) for angle in (10, 20, 30))
    (tmp_path / "go.mod").write_text(f"MODULE go\nPROC main()\n{body}\nENDPROC\nENDMODULE\n")
    words = ("run", "go.mod", "--no-record")
    began_s = process_time()
    report = json.loads(rapidsim(*words, "--timings", "--format", "json", cwd=tmp_path).out)
    spent_s = process_time() - began_s
    timings = report["timings"]
    names = ("reading", "solving", "planning", "program", "recording")
    assert [*timings] == [f"{name}_s" for name in names]
    assert all(seconds > 0.0 for seconds in timings.values())
    assert sum(timings.values()) < spent_s
    shown = rapidsim(*words, "--timings", cwd=tmp_path).out
    assert re.search(r"^processor time [\d.]+ s: reading [\d.]+, solving ", shown, re.MULTILINE)
    plain = rapidsim(*words, "--format", "json", cwd=tmp_path).out
    assert json.loads(plain) == {name: one for name, one in report.items() if name != "timings"}
