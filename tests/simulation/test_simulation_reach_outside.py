"""A target that depends on what comes from outside is judged by values that no cell may have."""

import json
from pathlib import Path

import pytest
from command_line import call

NEAR = "CONST robtarget near:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];"
PROGRAM = f"""MODULE outside
  {NEAR}
  VAR num by;
  VAR num place{{2}};
  VAR clock watch;
  FUNC num asked()
    RETURN GInput(giPlace)*2;
  ENDFUNC
  FUNC num known()
    RETURN ClkRead(watch)+5000;
  ENDFUNC
  PROC go(num way)
    MoveJ Offs(near,way+5000,0,0),v500,fine,tool0;
  ENDPROC
  PROC main()
    {{statements}}
  ENDPROC
ENDMODULE
"""


def severities(folder: Path, statements: str) -> list[tuple[str, str, str]]:
    file = folder / "outside.mod"
    file.write_text(PROGRAM.replace("{statements}", statements))
    ended = call("check", str(file), "--robot", "irb1600", "--output-format", "json", cwd=folder)
    found = json.loads(ended.out)["diagnostics"]
    lines = file.read_text().splitlines()
    return [
        (one["code"], one["severity"], lines[one["line"] - 1][one["column"] - 1 :][:4])
        for one in found
        if one["code"] == "K601"
    ]


@pytest.mark.parametrize(
    "statements",
    [
        "by:=GInput(giPlace); MoveJ Offs(near,by+5000,0,0),v500,fine,tool0;",
        "place{1}:=asked(); MoveJ Offs(near,place{1}+5000,0,0),v500,fine,tool0;",
        "MoveJ Offs(near,giPlace+5000,0,0),v500,fine,tool0;",
        "go asked();",
    ],
    ids=["input", "function", "signal", "parameter"],
)
def test_what_depends_on_inputs_is_a_warning(statements: str, tmp_path: Path) -> None:
    assert severities(tmp_path, statements) == [("K601", "warning", "Offs")]


def test_what_a_run_tells_without_inputs_is_an_error(tmp_path: Path) -> None:
    move = "by:=GInput(giPlace); MoveJ Offs(near,known(),0,0),v500,fine,tool0;"
    assert severities(tmp_path, move) == [("K601", "error", "Offs")]


@pytest.mark.parametrize(
    ("statement", "told"),
    [
        ("by:=place{3};", [("R101", "error")]),
        ("by:=place{giPlace};", [("R101", "warning")]),
        ('TPReadNum by,"which?"; by:=place{by};', []),
        ('TPReadNum by,"which?"\\MaxTime:=3;', [("R101", "warning")]),
        ('Open "HOME:/own.txt",f\\Write; Close f; by:=ReadNum(f);', [("R101", "error")]),
        ('Open "HOME:/others.txt",f\\Read;', []),
        ('IF NOT IsFile("HOME:/others.txt") by:=place{3};', []),
        ("SocketCreate s; SocketCreate s;", [("R101", "error")]),
        ('SocketCreate s; SocketConnect s,"10.0.0.1",5000;', []),
    ],
    ids=[
        *("known", "input", "question", "question that ends", "file of its own"),
        *("file of others", "asks for a file", "own socket", "socket of others"),
    ],
)
def test_an_error_of_main_is_one_unless_it_follows_from_outside(
    statement: str, told: list[tuple[str, str]], tmp_path: Path
) -> None:
    data = "VAR num by;\n VAR iodev f;\n VAR socketdev s;\n VAR num place{2};\n"
    module = f"MODULE m\n {data} PROC main()\n {{}}\n ENDPROC\nENDMODULE\n"
    (tmp_path / "main.mod").write_text(module.replace("{}", statement))
    ended = call("check", "main.mod", "--output-format", "json", cwd=tmp_path)
    found = json.loads(ended.out)["diagnostics"]
    assert [(one["code"], one["severity"]) for one in found if one["code"][0] == "R"] == told


WAITS_FOR_CLIENT = """VAR socketdev server; VAR socketdev client;
    SocketCreate server; SocketBind server,"127.0.0.1",5000; SocketListen server;
    SocketAccept server,client\\Time:=WAIT_MAX;"""
ONLY_A_RUN_TELLS = " WHILE by<3 DO Incr by; MoveJ Offs(p,by,0,0),v500,z10,t; ENDWHILE"


@pytest.mark.parametrize(
    ("data", "statements"),
    [
        ("VAR iodev file;", r'Open "HOME:"\File:="job.bin",file\Read;' + ONLY_A_RUN_TELLS),
        ("", WAITS_FOR_CLIENT + ONLY_A_RUN_TELLS),
        ("PERS num chosen;", "by:=place{chosen};"),
        ("", "NobodysOwn by; by:=place{by};" + ONLY_A_RUN_TELLS),
    ],
    ids=["file", "client", "persistent", "add-in"],
)
def test_what_a_check_cannot_have_makes_no_error(
    data: str, statements: str, tmp_path: Path
) -> None:
    (tmp_path / "main.mod").write_text(
        "MODULE m\n PERS tooldata t:=[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];\n"
        f" {NEAR.replace('near', 'p')}\n VAR num by;\n VAR num place{{2}};\n {data}\n"
        f" PROC main()\n {statements}\n ENDPROC\nENDMODULE\n"
    )
    arguments = ("check", "main.mod", "--assume-missing", "--output-format", "json")
    ended = call(*arguments, cwd=tmp_path)
    found = json.loads(ended.out)["diagnostics"]
    assert [one["severity"] for one in found if one["code"] in ("R101", "R106")] == ["warning"]
    assert not [one for one in found if one["severity"] == "error"]
