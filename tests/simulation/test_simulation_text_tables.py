"""Text tables: installed from a file, found by name and number, seen by all tasks."""

from pathlib import Path

import pytest
import simulation_tasks
from simulation_program import ran

TEXTS = """# texts of the deburring cell
deburring:: #user
#
0:
Deburring
1: #position
Teil 1 ist nicht in Stellung: prüfen
2:
""
10:
# nothing

glue::
1:
no glue
"""
PROGRAM = r"""MODULE cell
  VAR num table;
  PROC main()
    TPWrite ValToStr(TextTabFreeToUse("deburring"));
    TextTabInstall "HOME:/cell.eng";
    TPWrite ValToStr(TextTabFreeToUse("deburring"));
    table:=TextTabGet("deburring");
    TPWrite TextGet(table,0);
    TPWrite TextGet(table,1);
    TPWrite "["+TextGet(table,2)+"]";
    TPWrite TextGet(TextTabGet("glue"),1);
    {statement}
  ERROR
    TPWrite ValToStr(ERRNO={error});
    TRYNEXT;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    ("statement", "error"),
    [
        ("TPWrite TextGet(table,10);", "ERR_TXTNOEXIST"),
        ("TPWrite TextGet(table,0.5);", "ERR_TXTNOEXIST"),
        ("TPWrite TextGet(table+5,0);", "ERR_TXTNOEXIST"),
        ('table:=TextTabGet("none");', "ERR_TXTNOEXIST"),
        ('TextTabInstall "none.eng";', "ERR_FILEOPEN"),
        ('TextTabInstall "cell.eng";', "ERR_ARGVALERR"),
    ],
)
def test_texts_are_found_by_name_and_number(statement: str, error: str, tmp_path: Path) -> None:
    (tmp_path / "cell.eng").write_bytes(TEXTS.encode("iso-8859-1"))
    text = PROGRAM.replace("{statement}", statement).replace("{error}", error)
    assert ran(text, home=tmp_path).texts == [
        *("TRUE", "FALSE", "Deburring", "Teil 1 ist nicht in Stellung: prüfen", "[]", "no glue"),
        "TRUE",
    ]


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("<?xml version='1.0'?>\n<Texts/>\n", "cell.eng:1: a table begins with a line `name::`"),
        ("t::\nloose\n", "cell.eng:2: each text is one line below a line with its number"),
        ("t::\n1:\na\nb\n", "cell.eng:4: each text is one line below a line with its number"),
        ("t::\n1:\na\n1:\nb\n", "cell.eng:4: text 1 is here a second time"),
        (
            f"t::\n1:\n{'x' * 81}\n",
            "cell.eng:3: the text has 81 characters and a string at most 80",
        ),
        ("", "cell.eng:1: a table begins with a line `name::`"),
    ],
)
def test_another_format_is_refused_with_its_line(text: str, problem: str, tmp_path: Path) -> None:
    (tmp_path / "cell.eng").write_text(text)
    program = 'MODULE m\n  PROC main()\n    TextTabInstall "cell.eng";\n  ENDPROC\nENDMODULE\n'
    it = ran(program, home=tmp_path)
    assert [found.violation.message for found in it.run.diagnostics] == [f"{problem} (ERR_FILEACC)"]


def test_a_table_that_one_task_installs_is_there_for_the_others(tmp_path: Path) -> None:
    (tmp_path / "cell.eng").write_bytes(TEXTS.encode("iso-8859-1"))
    it = simulation_tasks.ran(
        {
            "T_ROB1": 'PROC main() WaitTime 1; TextTabInstall "cell.eng"; ENDPROC',
            "T_BACK": """PROC main()
              TPWrite ValToStr(TextTabFreeToUse("glue"));
              WaitTime 2;
              TPWrite TextGet(TextTabGet("glue"),1);
            ENDPROC""",
        },
        home=tmp_path,
    )
    assert it.texts == [(0.0, "TRUE"), (2.0, "no glue")]
