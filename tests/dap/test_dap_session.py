"""A session with the debug adapter: stops, steps, values, forwards and backwards.

Line numbers are looked up by the text of the line.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from dap_client import Client, RefusedError

CELL = """MODULE cell
  RECORD part
    num width;
    string label;
  ENDRECORD
  CONST num sizes{3}:=[1,2,3];
  PERS num count:=3;
  VAR part parts{2};
  VAR intnum beat;
  PROC main()
    VAR num own:=0.1;
    CONNECT beat WITH at_beat;
    ITimer 0.5,beat;
    bump own,parts{2}.width\\label:="b";
    bump count,own;
    FOR i FROM 1 TO 5 DO
      count:=count+i;
    ENDFOR
    WaitTime 0.6;
    TPWrite "one";
    risky;
    SetDO doGrip,1;
    TPWrite "two";
  ENDPROC
  PROC bump(INOUT num v,INOUT num w\\string label)
    v:=v+1;
    w:=v;
  ENDPROC
  TRAP at_beat
    Incr count;
    IDelete beat;
  ENDTRAP
  PROC risky()
    VAR num d;
    d:=1/d;
    TPWrite "behind";
  ERROR
    d:=sizes{2};
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
LINE = {text.strip(): number for number, text in enumerate(CELL.splitlines(), 1)}
FIRST = LINE["CONNECT beat WITH at_beat;"]
CALL = LINE['bump own,parts{2}.width\\label:="b";']
ADD = LINE["v:=v+1;"]
COPY = LINE["w:=v;"]
LOOP = LINE["count:=count+i;"]


@pytest.fixture
def client(tmp_path: Path) -> Iterator[Client]:
    (tmp_path / "cell.mod").write_text(CELL)
    (tmp_path / "rapidsim.toml").write_text('[signals]\ndoGrip = { type = "do" }\n')
    with Client(tmp_path) as session:
        yield session


pytestmark = pytest.mark.process


def test_it_runs_to_the_end_and_says_how(client: Client) -> None:
    client.launch("cell.mod")
    assert client.output() == "one\nbehind\ntwo\ncell.mod ended as programmed after 0.600 s\n"
    assert client.event("exited") == {"exitCode": 0}


def test_it_stops_on_entry_and_at_breakpoints(client: Client) -> None:
    client.launch("cell.mod", ADD, stopOnEntry=True)
    assert client.stopped() == {"reason": "entry", "threadId": 1, "allThreadsStopped": True}
    assert client.place() == ("main", FIRST)
    assert client.go("continue")["reason"] == "breakpoint"
    assert [(one["name"], one["line"]) for one in client.stack()] == [("bump", ADD), ("main", CALL)]
    assert client.label() == "t = 0.000 s, at rest"
    assert client.request("threads") == {"threads": [{"id": 1, "name": "T_ROB1"}]}


def test_a_breakpoint_moves_down_to_a_statement_or_is_refused(client: Client) -> None:
    client.launch("cell.mod", stopOnEntry=True)
    client.stopped()
    header = LINE["PROC risky()"]
    assert client.breaks("cell.mod", header, 900) == [
        {"verified": True, "line": LINE["d:=1/d;"]},
        {"verified": False, "message": "there is no statement on this line or below"},
    ]
    assert client.breaks("other.mod", 1) == [
        {"verified": False, "message": "the program does not have this file"}
    ]


def test_steps_forwards(client: Client) -> None:
    client.launch("cell.mod", CALL)
    client.stopped()
    walk = []
    for command in ("stepIn", "next", "next", "stepIn", "stepOut"):
        client.go(command)
        walk.append(client.place())
    assert walk == [
        ("bump", ADD),
        ("bump", COPY),
        ("main", CALL + 1),
        ("bump", ADD),
        ("main", LINE["FOR i FROM 1 TO 5 DO"]),
    ]


def test_steps_backwards_restore_data_and_go_forwards_again(client: Client) -> None:
    client.launch("cell.mod", COPY)
    client.stopped()
    assert client.scope("Routine") == {"v": "1.1", "w": "0", "label": '"b"'}
    client.go("stepBack")
    assert client.place() == ("bump", ADD)
    assert client.scope("Routine") == {"v": "0.1", "w": "0", "label": '"b"'}
    client.go("stepBack")
    assert client.place() == ("main", CALL)
    assert client.scope("Routine") == {"own": "0.1"}
    client.breaks("cell.mod")
    client.go("next")
    assert client.place() == ("main", CALL + 1)
    assert client.scope("Routine") == {"own": "1.1"}
    client.request("continue")
    assert client.output() == "one\nbehind\ntwo\ncell.mod ended as programmed after 0.600 s\n"


def test_it_cannot_go_back_beyond_the_first_statement(client: Client) -> None:
    client.launch("cell.mod", stopOnEntry=True)
    client.stopped()
    with pytest.raises(RefusedError, match="first statement of the task"):
        client.request("stepBack")


def test_reverse_continue_goes_to_the_breakpoint_before(client: Client) -> None:
    client.launch("cell.mod", ADD, LOOP)
    places = [client.stopped() and (*client.place(), client.value("count"))]
    for _ in range(3):
        client.go("continue")
        places.append((*client.place(), client.value("count")))
    back = []
    for _ in range(3):
        client.go("reverseContinue")
        back.append((*client.place(), client.value("count")))
    assert back == places[-2::-1]
    client.go("reverseContinue")
    assert client.place() == ("main", FIRST)


def test_conditions_and_hit_counts(client: Client) -> None:
    client.launch("cell.mod", {"line": LOOP, "condition": "i=3 AND count>5"})
    client.stopped()
    assert client.value("i") == "3"
    client.breaks("cell.mod", {"line": LOOP, "hitCondition": "% 2"})
    client.go("continue")
    assert client.value("i") == "5"


def test_a_condition_may_call_functions(client: Client) -> None:
    client.launch("cell.mod", {"line": LOOP, "condition": "Pow(i,2)>10"})
    client.stopped()
    assert client.value("i") == "4"


def test_a_wrong_condition_stops_and_says_why(client: Client) -> None:
    client.launch(
        "cell.mod", {"line": LOOP, "condition": "nope>2"}, {"line": ADD, "hitCondition": "x"}
    )
    client.stopped()
    assert client.value("i") == "1"
    said = client.event("output")["output"]
    assert said == "the condition cannot be evaluated: `nope` is not the name of data here\n"


def test_log_points_print_and_do_not_stop(client: Client) -> None:
    client.launch("cell.mod", {"line": LOOP, "logMessage": "i is {i}, {sizes{i}} and {i*2+0.5}"})
    lines = client.output().splitlines()
    assert lines[:3] == ["i is 1, 1 and 2.5", "i is 2, 2 and 4.5", "i is 3, 3 and 6.5"]
    assert lines[3] == "i is 4, (`sizes{i}`: there is no element 4) and 8.5"


def test_values_of_all_scopes(client: Client) -> None:
    client.launch("cell.mod", ADD)
    client.stopped()
    assert client.scope("Routine") == {"v": "0.1", "w": "0", "label": '"b"'}
    assert client.scope("Module") == {
        "sizes": "[1,2,3]",
        "count": "3",
        "parts": '[[0,""],[0,""]]',
        "beat": "1",
    }
    assert client.scope("Persistents") == {"count": "3"}
    assert client.scope("Signals") == {"doGrip": "0"}
    robot = client.scope("Robot")
    assert robot["program pointer"] == f"cell.mod:{ADD}: v:=v+1"
    assert robot["tool"] == "tool0"
    assert robot["axes"].startswith("[[0,0,0,0,30,0],")


def test_records_and_arrays_are_unfolded(client: Client) -> None:
    client.launch("cell.mod", ADD)
    client.stopped()
    parts = next(one for one in client.lines("Module") if one["name"] == "parts")
    elements = client.request("variables", variablesReference=parts["variablesReference"])
    second = elements["variables"][1]
    assert (second["name"], second["evaluateName"], second["type"]) == ("[2]", "parts{2}", "part")
    fields = client.request("variables", variablesReference=second["variablesReference"])
    assert [(one["name"], one["value"]) for one in fields["variables"]] == [
        ("width", "0"),
        ("label", '""'),
    ]


@pytest.mark.parametrize(
    ("expression", "wanted"),
    [
        ("v", "0.1"),
        ("v*10 = 1 AND NOT count < 3", "TRUE"),
        ("parts{2}.label", '""'),
        ('label + "c"', '"bc"'),
        ("sizes{2} DIV 2", "1"),
        ("doGrip = 0", "TRUE"),
        ("[1,0,0]", None),
        ("Abs(-3) + v", "3.1"),
        ("StrLen(label)", "1"),
        ("sizes{4}", None),
        ("v +", None),
        ("x := 2; y", None),
    ],
)
def test_expressions(tmp_path: Path, expression: str, wanted: str | None) -> None:
    (tmp_path / "cell.mod").write_text(CELL)
    (tmp_path / "rapidsim.toml").write_text('[signals]\ndoGrip = { type = "do" }\n')
    with Client(tmp_path) as client:
        client.launch("cell.mod", ADD)
        client.stopped()
        if wanted is None:
            with pytest.raises(RefusedError):
                client.value(expression)
        else:
            assert client.value(expression) == wanted


def test_set_values_stay_set_on_the_way_back_and_forth(client: Client) -> None:
    client.launch("cell.mod", COPY)
    client.stopped()
    number = client.request("scopes", frameId=client.stack()[0]["id"])["scopes"][0]
    reference = number["variablesReference"]
    client.request("variables", variablesReference=reference)
    set_to = client.request("setVariable", variablesReference=reference, name="v", value="7")
    assert set_to == {"value": "7"}
    assert client.value("parts{1}.width:=4", context="repl") == "4"
    client.go("next")
    assert client.value("own") == "7"
    client.go("stepBack")
    client.go("stepBack")
    assert client.place() == ("bump", ADD)
    assert client.value("v") == "0.1"
    client.go("next")
    assert client.scope("Routine")["v"] == "7"
    assert client.value("parts{1}.width") == "4"


def test_what_cannot_be_set_says_why(client: Client) -> None:
    client.launch("cell.mod", LOOP)
    client.stopped()
    for expression, value, why in (
        ("sizes{1}", "3", "constant"),
        ("i", "3", "counter of a FOR"),
        ("count", "TRUE", "`TRUE` is no num"),
        ("nope", "1", "not the name of data"),
    ):
        with pytest.raises(RefusedError, match=why):
            client.request("setExpression", expression=expression, value=value)


def test_a_signal_is_set_and_watched(client: Client) -> None:
    client.launch("cell.mod", LOOP)
    client.stopped()
    signals = client.request("scopes", frameId=client.stack()[0]["id"])["scopes"][3]
    reference = signals["variablesReference"]
    client.request("setVariable", variablesReference=reference, name="doGrip", value="1")
    assert client.value("doGrip") == "1"
    info = client.request("dataBreakpointInfo", variablesReference=reference, name="doGrip")
    assert info["dataId"] == "signal:doGrip"
    client.breaks("cell.mod")
    client.request("setDataBreakpoints", breakpoints=[{"dataId": info["dataId"]}])
    client.request("continue")
    assert "ended as programmed" in client.output()


def test_data_breakpoints_stop_after_a_change(client: Client) -> None:
    client.launch("cell.mod", stopOnEntry=True)
    client.stopped()
    info = client.request("dataBreakpointInfo", name="count")
    client.request("setDataBreakpoints", breakpoints=[{"dataId": info["dataId"]}])
    stop = client.go("continue")
    assert stop["reason"] == "data breakpoint"
    assert stop["text"] == "T_ROB1/count changed from 3 to 4"
    assert client.place() == ("bump", COPY)
    own = client.request("dataBreakpointInfo", name="v")
    assert own["dataId"] is None


def test_errors_by_name_and_those_that_end_the_program(client: Client) -> None:
    client.launch("cell.mod", stopOnEntry=True)
    client.stopped()
    options = [{"filterId": "all", "condition": "ERR_DIVZERO"}]
    client.request("setExceptionBreakpoints", filters=[], filterOptions=options)
    stop = client.go("continue")
    assert (stop["reason"], stop["text"]) == ("exception", "ERR_DIVZERO: division by zero")
    assert client.place() == ("risky", LINE["d:=1/d;"])
    info = client.request("exceptionInfo", threadId=1)
    assert info["description"] == "ERR_DIVZERO: division by zero"
    client.go("next")
    assert client.place() == ("the ERROR clause of risky", LINE["d:=sizes{2};"])


def test_other_errors_do_not_stop(client: Client) -> None:
    client.launch("cell.mod", stopOnEntry=True)
    client.stopped()
    options = [{"filterId": "all", "condition": "ERR_ILLDIM, 41617"}]
    client.request("setExceptionBreakpoints", filters=[], filterOptions=options)
    client.request("continue")
    assert "ended as programmed" in client.output()


def test_the_error_that_ends_the_program_is_gone_back_to(tmp_path: Path) -> None:
    text = CELL.replace("  ERROR\n    d:=sizes{2};\n    TRYNEXT;\n", "")
    (tmp_path / "cell.mod").write_text(text)
    with Client(tmp_path) as client:
        client.launch("cell.mod", filters=("unhandled",))
        stop = client.stopped()
        assert stop["reason"] == "exception"
        assert client.place() == ("risky", LINE["d:=1/d;"])
        assert client.value("d") == "0"
        client.go("stepBack")
        assert client.place() == ("main", LINE["risky;"])
        client.request("continue")
        assert "stopped with an error" in client.output()


def test_traps_are_seen_and_virtual_time_is_run_to(client: Client) -> None:
    client.launch("cell.mod", stopOnEntry=True)
    client.stopped()
    answer = client.request("evaluate", expression="until 0.4", context="repl")
    assert answer["result"] == "runs to 0.4 s"
    client.stopped()
    assert client.place() == ("at_beat", LINE["Incr count;"])
    assert client.label().startswith("t = 0.500 s")
    client.request("runToTime", time=0.55)
    client.stopped()
    assert client.place() == ("main", LINE['TPWrite "one";'])
    with pytest.raises(RefusedError, match=r"no statement begins at 9 s"):
        client.request("runToTime", time=9)


def test_restart_and_restart_of_a_routine(client: Client) -> None:
    client.launch("cell.mod", COPY)
    client.stopped()
    client.request("restartFrame", frameId=client.stack()[0]["id"])
    client.stopped()
    assert client.place() == ("bump", ADD)
    client.request("restart")
    assert client.stopped()["reason"] == "entry"
    assert client.place() == ("main", FIRST)


def test_pause_stops_a_program_that_never_ends(tmp_path: Path) -> None:
    text = (
        "MODULE m\nPROC main()\nVAR num n;\nWHILE TRUE DO\nn:=n+1;\nENDWHILE\nENDPROC\nENDMODULE\n"
    )
    (tmp_path / "cell.mod").write_text(text)
    with Client(tmp_path) as client:
        # Far from the first statement, however soon the pause comes.
        client.launch("cell.mod", {"line": 5, "hitCondition": "= 200"})
        client.stopped()
        client.breaks("cell.mod")
        client.request("continue")
        with pytest.raises(RefusedError, match="pause it first"):
            client.request("stackTrace", threadId=1)
        assert client.go("pause")["reason"] == "pause"
        before = client.value("n")
        # A turn stops at the head of the loop and at the assignment.
        for _ in range(4):
            client.go("stepBack")
        assert float(client.value("n")) == float(before) - 2


def test_a_routine_of_an_earlier_stop_has_no_scopes(client: Client) -> None:
    client.launch("cell.mod", ADD)
    client.stopped()
    assert client.request("scopes", frameId=99) == {"scopes": []}


def test_what_is_asked_wrongly_is_refused(client: Client) -> None:
    client.launch("cell.mod", ADD)
    client.stopped()
    with pytest.raises(RefusedError, match="`nonsense` is not supported"):
        client.request("nonsense")
    with pytest.raises(RefusedError, match="wrong arguments"):
        client.request("setBreakpoints")
    with pytest.raises(RefusedError, match="earlier stop"):
        client.request("variables", variablesReference=99)
    with pytest.raises(RefusedError, match="there is no thread 7"):
        client.request("stackTrace", threadId=7)


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        ({"program": "nope.mod"}, "does not exist"),
        ({"program": []}, "`program` names"),
        ({"program": "cell.mod", "robot": "nope"}, "nope"),
        ({"program": "broken.mod"}, "broken.mod:2"),
    ],
)
def test_a_program_that_cannot_run_says_why(
    client: Client, arguments: dict[str, object], why: str
) -> None:
    (client.folder / "broken.mod").write_text("MODULE b\n  PROC main(\n  ENDPROC\nENDMODULE\n")
    client.request("initialize")
    arguments = {"cwd": str(client.folder), **arguments}
    with pytest.raises(RefusedError, match=why):
        client.request("launch", **arguments)


def test_files_that_the_program_writes_go_back_too(tmp_path: Path) -> None:
    text = """MODULE files
  PROC main()
    VAR iodev log;
    Open "HOME:"\\File:="log.txt",log\\Write;
    FOR i FROM 1 TO 4 DO
      Write log,"line "\\Num:=i;
    ENDFOR
    Close log;
    WaitTime 1;
  ENDPROC
ENDMODULE
"""
    (tmp_path / "files.mod").write_text(text)
    (tmp_path / "home").mkdir()
    with Client(tmp_path) as client:
        client.launch("files.mod", 8, home="home")
        client.stopped()
        for _ in range(3):
            client.go("stepBack")
        client.breaks("files.mod", 9)
        client.go("continue")
        assert (tmp_path / "home" / "log.txt").read_text() == "line 1\nline 2\nline 3\nline 4\n"
