"""The tools for agents: what they reject, what they repair, and how large their answers are."""

from __future__ import annotations

import asyncio
import json
import os
import random
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from laws import some

from rapidsim.agents.knowledge_tools import explain, reach, search_library, signature
from rapidsim.agents.paging import LARGEST, paged
from rapidsim.agents.program_tools import check, diff, fix, run
from rapidsim.agents.worker import Worker
from rapidsim.files import InputError

GOOD = """MODULE Work
  CONST robtarget p10:=[[600,0,800],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p20:=[[600,200,800],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num count:=0;
  PROC main()
    MoveJ p10,v500,fine,tool0;
    FOR i FROM 1 TO 3 DO
      MoveL p20,v200,z10,tool0;
      MoveL p10,v200,fine,tool0;
      count:=count+i;
      WaitTime 0.5;
    ENDFOR
    IF count>5 THEN
      TPWrite "many "\\Num:=count;
    ELSE
      TPWrite "few";
    ENDIF
    AccSet 50,50;
    VelSet 80,1000;
  ENDPROC
ENDMODULE
"""
NO_AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
NAMES = [
    *("MoveJ", "MoveL", "WaitTime", "TPWrite", "AccSet", "VelSet", "v500", "v200", "z10", "fine"),
    *("tool0", "count", "p10", "p20", "robtarget"),
]


def invented(number: int) -> tuple[str, int, str, str]:
    """The program with one invented name: its text, the line, the name and what is meant."""
    chance = random.Random(number)
    name = NAMES[number % len(NAMES)]
    lines = GOOD.splitlines()
    places = [k for k, line in enumerate(lines) if name in line and ":=" not in line]
    place = chance.choice(places or [k for k, line in enumerate(lines) if name in line])
    at = chance.randrange(1, len(name))
    wrong = chance.choice([name[:at] + name[at + 1 :], name[:at] + "x" + name[at:], f"{name}Safe"])
    # Some names exist, and `Move` may be any of three.
    if wrong.lower() in {one.lower() for one in (*NAMES, "z0", "Move")}:
        wrong = f"{name}Safe"
    lines[place] = lines[place].replace(name, wrong, 1)
    return "\n".join(lines) + "\n", place + 1, wrong, name


def test_the_program_is_good() -> None:
    answer = check({"Main.mod": GOOD}, robot="irb1600")
    assert answer["ok"], answer["findings"]
    ran = run({"Main.mod": GOOD}, robot="irb1600")
    assert (ran["ok"], ran["moves"], ran["texts"][0]["text"]) == (True, 7, "many 6")


@pytest.mark.parametrize("number", some(range(60), 3))
def test_an_invented_name_is_rejected_at_its_line_and_the_meant_one_said(number: int) -> None:
    text, line, wrong, meant = invented(number)
    answer = check({"Main.mod": text}, robot="irb1600")
    assert not answer["ok"]
    found = [
        one
        for one in answer["findings"]
        if one["line"] == line and f"`{wrong}`" in one["message"] and one["severity"] == "error"
    ]
    assert found, answer["findings"]
    if not wrong.endswith("Safe") and len(meant) > 4:
        assert any(meant.lower() in one.get("help", "").lower() for one in found), found


BREAKS: list[tuple[str, str]] = [
    *(("fine,tool0;", "fine,tool0"), ("ENDFOR", "NEXT"), ("THEN", ""), ("DO\n", "\n")),
    *((":=count+i", "=count+i"), ("WaitTime 0.5;", "WaitTime(0.5);"), ("ENDIF", "END IF")),
    *(("TPWrite", "TpWrit"), ("MoveJ", "MovJ"), ("count>5", "count=>5"), ('"few"', '"few')),
    *(("PROC main()", "PROC main"), ("VelSet 80,1000;", "VelSet 80;"), ("ELSE", "else:")),
    *(("AccSet 50,50;", "AccSet 50 50;"), ("v500", "v501"), ("z10", "z11"), ("tool0", "tol0")),
    *(("FROM 1 TO", "= 1 TO"), ("ENDPROC", "END"), ("IF count", "if (count")),
]


BREAKS += [
    *(("MoveJ p10,", "MoveJ p10 "), ("z10,tool0", "z10 tool0"), ("WaitTime 0.5;", "WaitTime 0.5")),
    *(("    ENDIF\n", ""), ("    ENDFOR\n", ""), ("ENDMODULE\n", ""), ("  ENDPROC\n", "")),
    *(('TPWrite "few";', 'TPWrite("few");'), (":=count+i", "+=i"), (":=count+i", "==count+i")),
    *(("count>5", "count == 6"), ("count>5", "count != 5"), ("count>5", "count>5 && count<9")),
    *(("count:=0", "count=0"), ("VAR num count", "num count"), ("PROC main()", "PROC main():")),
    *(("PROC main()", "PROCEDURE main()"), ("MODULE Work", "MODULE Work;"), (" 3 DO", " 3")),
    *(("FROM 1", "IN 1"), ("\\Num:=", "\\Num="), ("\\Num:=", "/Num:="), ('"many "', "'many '")),
    *(("robtarget p10", "robtaget p10"), ("[600,200,800]", "[600,200,800"), ("ENDIF", "EndIF;")),
    *(("ELSE", "ELSEIF"), ("MoveL p10", "moveL p1O"), ("AccSet 50,50;", "AccSet(50,50);")),
]
"""Mistakes of people and of agents that know other languages better."""


NOT_REPAIRED = {
    *("NEXT", "VelSet 80;", "z11", "count != 5", "num count", "PROCEDURE main()", "/Num:="),
    *("'many '", "[600,200,800", "ELSEIF"),
}
"""What no fix can know: of 50 breaks 40 are repaired."""


def test_fixes_alone_repair_what_they_can() -> None:
    left = set()
    for old, new in BREAKS:
        assert old in GOOD, old
        answer = fix({"Work.mod": GOOD.replace(old, new, 1)}, robot="irb1600")
        if not answer["ok"]:
            left.add(new)
    assert left == NOT_REPAIRED
    assert (len(BREAKS), len(left)) == (50, 10)


def test_nothing_outside_of_what_was_sent_is_read() -> None:
    for name in ("../a.mod", "/etc/passwd", "C:\\a.mod", "a/../../b.mod", "a.py"):
        with pytest.raises(InputError):
            check({name: GOOD})
    with pytest.raises(InputError):
        check({})


def test_long_answers_come_in_pages_that_fit() -> None:
    lines = [f"    nope{number} {number};" for number in range(300)]
    text = "\n".join(["MODULE m", "  PROC main()", *lines, "  ENDPROC", "ENDMODULE", ""])
    cursor: int | None = 0
    seen: list[int] = []
    while cursor is not None:
        answer = check({"m.mod": text}, cursor=cursor)
        assert len(json.dumps(answer)) < LARGEST * 1.2
        seen += [one["line"] for one in answer["findings"]]
        cursor = answer["next_cursor"]
    assert sorted(seen) == list(range(3, 303))


def test_a_page_has_at_least_one_entry() -> None:
    answer = paged({"a": ["x" * 20000, "y"]}, ("a",), 0)
    assert (len(answer["a"]), answer["next_cursor"]) == (1, 1)
    assert paged({"a": ["x" * 20000, "y"]}, ("a",), 1)["a"] == ["y"]


def test_reach_names_configurations_or_what_is_short() -> None:
    near = reach(
        "[[300,0,400],[0.7071068,0,0.7071068,0],[0,0,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]]", "irb120"
    )
    assert near["reachable"]
    assert [one["conf"] for one in near["configurations"] if one["is_stored"]] == [[0, 0, 0, 1]]
    far = reach(f"[[3000,0,400],[1,0,0,0],[0,0,0,0],{NO_AXES}]", "irb120")
    assert (far["reachable"], far["reason"]) == (False, "wrist centre 2420.2 mm beyond reach")
    for target, robot in (("[[1,2]]", "irb120"), ("", "irb120"), ("p10", "irb120"), ("[]", "nope")):
        with pytest.raises(InputError):
            reach(target, robot)


def test_the_library_and_the_rules_are_explained() -> None:
    assert explain("unreachable-target")["code"] == "K601"
    assert (
        signature("offs")["signature"]
        == "FUNC robtarget Offs(robtarget Point, num XOffset, num YOffset, num ZOffset)"
    )
    assert [one["name"] for one in search_library("waitdi")["routines"]] == ["WaitDI"]
    wrong: list[Callable[[], object]] = [lambda: explain("K999"), lambda: signature("MoveLL")]
    for call in wrong:
        with pytest.raises(InputError):
            call()


def test_two_versions_are_compared() -> None:
    changed = GOOD.replace("WaitTime 0.5", "WaitTime 0.7")
    answer = diff({"Main.mod": GOOD}, {"Main.mod": changed}, robot="irb1600")
    assert not answer["same"]
    assert any("0.5 -> 0.7" in str(one) for one in answer["changes"])
    assert diff({"Main.mod": GOOD}, {"Main.mod": GOOD}, robot="irb1600")["same"]


@pytest.mark.process
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux limits the memory of a process")
def test_a_program_that_needs_too_much_memory_is_an_error_and_the_next_one_runs() -> None:
    large = """MODULE Large
  VAR num values{3000,4900};
  PROC main()
    values{1,1}:=1;
  ENDPROC
ENDMODULE
"""
    worker = Worker(most_bytes=260_000_000)
    try:
        with pytest.raises(InputError) as error:
            worker.call(run, {"Large.mod": large}, robot="irb120")
        assert "needs more than 0.26 GB of memory" in error.value.message
        assert worker.call(run, {"Main.mod": GOOD}, robot="irb1600")["end"] == "ended"
    finally:
        worker.close()


@pytest.mark.process
def test_a_process_that_is_killed_leaves_no_files_and_is_replaced() -> None:
    worker = Worker()
    try:
        with pytest.raises(InputError, match="or its process was killed"):
            worker.call(leave_a_folder_and_exit)
        with pytest.raises(InputError) as error:
            worker.call(explain, "undefined-nam")
        assert error.value.help == "did you mean `undefined-name`?"
        assert error.value.similar == ("undefined-name",)
        assert not list(Path(tempfile.gettempdir()).glob(f"rapidsim-agents-*/left-{os.getpid()}-*"))
    finally:
        worker.close()


def leave_a_folder_and_exit() -> None:
    tempfile.mkdtemp(prefix=f"left-{os.getppid()}-")
    os._exit(1)


@pytest.mark.process
def test_the_official_client_lists_and_calls_the_tools() -> None:
    client = pytest.importorskip("mcp", reason="the extra `mcp` is not installed")
    stdio = pytest.importorskip("mcp.client.stdio")

    async def session() -> tuple[list[Any], Any, Any]:
        server = client.StdioServerParameters(
            command=sys.executable, args=["-m", "rapidsim", "mcp"]
        )
        async with (
            stdio.stdio_client(server) as streams,
            client.ClientSession(*streams) as connected,
        ):
            await connected.initialize()
            tools = (await connected.list_tools()).tools
            text, line, wrong, _ = invented(1)
            found = await connected.call_tool("check", {"files": {"a.mod": text}})
            refused = await connected.call_tool("check", {"files": {"../a.mod": text}})
            assert any(
                one["line"] == line and wrong in one["message"]
                for one in found.structured_content["findings"]
            )
            return tools, found, refused

    tools, found, refused = asyncio.run(session())
    names = {tool.name for tool in tools}
    assert names >= {
        "check",
        "run",
        "fix",
        "reach",
        "explain",
        "signature",
        "search_library",
        "diff",
    }
    assert all(tool.annotations.read_only_hint for tool in tools)
    assert not found.is_error
    assert (
        refused.structured_content["error"]["message"] == "`../a.mod` is no name of a file to send"
    )
