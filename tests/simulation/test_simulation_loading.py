"""Modules that a program loads, calls and removes while it runs."""

from pathlib import Path

import pytest
import simulation_tasks
from simulation_program import Ran, ran
from simulation_reach import checked

from rapidsim.analysis.rules.names.late_names import AmbiguousLateBinding
from rapidsim.analysis.rules.names.unused import UnusedData, UnusedRoutine
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.diagnostics import Severity
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.error_numbers import ERR_FILEACC, ERR_MOD_NOTLOADED, ERR_UNLOAD

MAIN = r"""MODULE cell
  VAR num count:=5;
  VAR loadsession session;
  VAR num n;
  PROC main()
    {statements}
  ERROR
    TPWrite "error "+ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC told(num number)
    TPWrite ValToStr(number);
  ENDPROC
ENDMODULE
"""
PART = r"""MODULE part
  PERS num total:=10;
  VAR num calls;
  LOCAL PROC main()
    count:=count+1;
    told count;
  ENDPROC
  PROC draw(num by\switch twice)
    Incr calls;
    total:=total+by;
    IF Present(twice) total:=total+by;
    told total;
  ENDPROC
  FUNC num doubled(num x)
    RETURN 2*x;
  ENDFUNC
ENDMODULE
"""


def main(*statements: str) -> str:
    return MAIN.replace("{statements}", "\n    ".join(statements))


def ran_with(home: Path, *statements: str, assumes: bool = False, **files: str) -> Ran:
    for name, text in files.items():
        (home / f"{name}.mod").write_text(text)
    return ran(main(*statements), home=home, assumes=assumes)


def test_a_loaded_module_uses_the_program_and_is_called_by_name(tmp_path: Path) -> None:
    it = ran_with(
        tmp_path,
        r'Load \Dynamic,"HOME:" \File:="part.mod" \CheckRef;',
        '%"part:main"%;',  # LOCAL PROC main: two mains do not clash.
        '%"draw"% 3;',
        r'%"draw"% 4\twice;',
        'GetDataVal "calls",n;',
        "told n;",
        r'UnLoad "HOME:" \File:="part.mod";',
        'TPWrite ValToStr(ModExist("part"));',
        '%"draw"% 3;',
        part=PART,
    )
    assert it.texts == ["6", "13", "21", "2", "FALSE", "error 20137"]
    first, *_ = (event for event in it.run.events if event.message == "6")
    assert first.place is not None
    assert first.place.span.file == "cell.mod"
    assert [e.message for e in it.run.events if e.kind == "file"] == [
        "opened HOME:/part.mod to load"
    ]


def test_a_module_begins_anew_each_time_and_the_others_keep_their_values(tmp_path: Path) -> None:
    it = ran_with(
        tmp_path,
        "FOR i FROM 1 TO 3 DO",
        'Load "part.mod";',
        '%"part:main"%;',
        '%"draw"% i;',
        'UnLoad "HOME:/part.mod";',
        "ENDFOR",
        part=PART,
    )
    assert it.texts == ["6", "11", "7", "12", "8", "13"]


def test_save_writes_the_values_of_persistents(tmp_path: Path) -> None:
    it = ran_with(
        tmp_path,
        'Load "part.mod";',
        '%"draw"% 3;',
        r'Save \TaskName:="T_ROB1","part" \FilePath:="HOME:/kept" \File:="copy.mod";',
        '%"draw"% 4;',
        r'UnLoad \Save,"part.mod";',
        'Load "part.mod";',
        '%"draw"% 1;',
        'Save "cell";',
        part=PART,
    )
    assert it.texts == ["13", "17", "18", "error 20122"]
    assert (tmp_path / "kept" / "copy.mod").read_text() == PART.replace(":=10", ":=13")
    assert (tmp_path / "part.mod").read_text() == PART.replace(":=10", ":=17")


def test_a_file_written_after_its_module_was_loaded_is_later(tmp_path: Path) -> None:
    told = r'TPWrite ValToStr(FileTime("part.mod" \ModifyTime)>ModTime("part"));'
    it = ran_with(
        tmp_path,
        "VAR iodev device;",
        "VAR stringdig digits;",
        'Load "part.mod";',
        told,
        "WaitTime 1000;",
        'CopyFile "part.mod","copy.mod";',
        told,
        r'Open "part.mod",device \Append;',
        "Close device;",
        told,
        'UnLoad "part.mod";',
        'Load "part.mod";',
        told,
        r'TPWrite ValToStr(FileTimeDnum("copy.mod" \AccessTime)-ModTimeDnum("cell"));',
        r'TPWrite ValToStr(ModTime("part" \StrDig:=digits)>0)+digits;',
        'TPWrite ValToStr(FileTime("none.mod"));',
        'TPWrite ValToStr(ModTime("none"));',
        part=PART,
    )
    assert it.texts == [
        *("FALSE", "FALSE", "TRUE", "FALSE", "1000", "TRUE946685800"),
        f"error {ERR_FILEACC:g}",
        f"error {ERR_MOD_NOTLOADED:g}",
    ]


def test_a_load_session_reads_first_and_links_later(tmp_path: Path) -> None:
    it = ran_with(
        tmp_path,
        'Load "part.mod";',
        r'StartLoad \Dynamic,"HOME:" \File:="other.mod",session;',
        'StartLoad "other.mod",session;',
        'TPWrite ValToStr(ModExist("other"));',
        r'WaitLoad \UnloadPath:="HOME:" \UnloadFile:="part.mod",session;',
        'TPWrite ValToStr(ModExist("other"))+ValToStr(ModExist("part"));',
        "WaitLoad session;",
        'StartLoad "part.mod",session;',
        "CancelLoad session;",
        "CancelLoad session;",
        part=PART,
        other="MODULE other\nENDMODULE\n",
    )
    in_use, unknown, not_in_use = "error 20096", "error 20196", "error 20097"
    assert it.texts == [in_use, "FALSE", "TRUEFALSE", unknown, not_in_use]


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("MODULE part\n  PROC draw(\nENDMODULE\n", "ERR_SYNTAX"),
        ("nothing\n", "ERR_SYNTAX"),
        ("MODULE cell\nENDMODULE\n", "ERR_LOADED"),
        ("MODULE part\n  PROC told()\n  ENDPROC\nENDMODULE\n", "ERR_LINKREF"),
        ('MODULE part\n  VAR num x:="a";\nENDMODULE\n', "ERR_LINKREF"),
        ("MODULE part\n  PROC draw()\n    count:=missing;\n  ENDPROC\nENDMODULE\n", "ERR_LINKREF"),
        ("MODULE part\n  PROC draw()\n    away;\n  ENDPROC\nENDMODULE\n", "ERR_LINKREF"),
        ("MODULE part\n  VAR num x:=1/0;\nENDMODULE\n", "ERR_DIVZERO"),
    ],
)
def test_what_cannot_be_loaded_leaves_the_program_as_it_was(
    text: str, error: str, tmp_path: Path
) -> None:
    it = ran_with(
        tmp_path,
        r'Load "part.mod" \CheckRef;',
        f"TPWrite ValToStr(ERRNO={error});",
        'TPWrite ValToStr(ModExist("part"));',
        "CheckProgRef;",
        "told count;",
        part=text,
    )
    assert it.texts[1:] == ["TRUE", "FALSE", "5"]


@pytest.mark.parametrize(
    ("statement", "error"),
    [
        ('Load "none.mod";', "ERR_FILNOTFND"),
        ('Load "../part.mod";', "ERR_FILNOTFND"),
        ('StartLoad "none.mod",session;WaitLoad session;', "ERR_FILNOTFND"),
        ('UnLoad "part.mod";', "ERR_UNLOAD"),
        ('EraseModule "none";', "ERR_MODULE"),
        ('EraseModule "cell";', "ERR_MODULE"),
        ('Save "none";', "ERR_MODULE"),
        (r'Save "cell" \FilePath:="HOME:/../cell.mod";', "ERR_IOERROR"),
        (r'Save \TaskName:="T_NONE","cell" \FilePath:="cell.mod";', "ERR_TASKNAME"),
    ],
)
def test_each_mistake_has_the_manuals_error(statement: str, error: str, tmp_path: Path) -> None:
    it = ran_with(tmp_path, statement, f"TPWrite ValToStr(ERRNO={error});", part=PART)
    assert it.texts[1:] == ["TRUE"]
    assert list(tmp_path.parent.glob("*.mod")) == []


def test_a_second_module_of_a_name_is_told_where_the_first_is_from(tmp_path: Path) -> None:
    def refused(text: str, *statements: str) -> str:
        (tmp_path / "part.mod").write_text(text)
        body = "\n".join((*statements, 'Load "part.mod";'))
        program = f"MODULE cell\n  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n"
        return ran(program, home=tmp_path).only("R101").violation.message

    given = "part.mod: there is a module Cell already: the task began with it; "
    assert refused("MODULE Cell\nENDMODULE\n").lower().startswith(given.lower())
    loaded = "part.mod: there is a module part already: it was loaded from HOME:/part.mod; "
    assert refused("MODULE part\nENDMODULE\n", 'Load "HOME:/part.mod";').startswith(loaded)


def test_a_module_that_executes_stays(tmp_path: Path) -> None:
    text = 'MODULE part\n  PROC draw()\n    UnLoad "part.mod";\n  ENDPROC\nENDMODULE\n'
    it = ran_with(
        tmp_path,
        'Load "part.mod";',
        '%"draw"%;',
        'UnLoad "part.mod";',
        'TPWrite ValToStr(ModExist("part"));',
        part=text,
    )
    assert it.texts == ["error 20197", "FALSE"]


def test_a_module_waits_for_names_that_a_later_one_declares(tmp_path: Path) -> None:
    job = "MODULE job\n  PROC work()\n    told size;\n    size:=size+1;\n  ENDPROC\nENDMODULE\n"
    sizes = "MODULE sizes\n  VAR num size:=7;\nENDMODULE\n"
    it = ran_with(
        tmp_path,
        'Load "job.mod";',
        '%"work"%;',
        "CheckProgRef;",
        'Load "sizes.mod";',
        '%"work"%;',
        '%"work"%;',
        'UnLoad "sizes.mod";',  # The job waits again.
        '%"work"%;',
        r'Load "sizes.mod" \CheckRef;',
        '%"work"%;',
        job=job,
        sizes=sizes,
    )
    unknown_data, unresolved = "error 20135", "error 20092"
    assert it.texts == [unknown_data, unresolved, "7", "8", unknown_data, "7"]


def test_a_module_waits_for_the_components_of_a_type(tmp_path: Path) -> None:
    job = """MODULE job
  VAR piece one;
  PROC work()
    one.width:=3;
    told one.width;
  ENDPROC
ENDMODULE
"""
    it = ran_with(
        tmp_path,
        'Load "job.mod";',
        '%"work"%;',
        'Load "types.mod";',
        '%"work"%;',
        job=job,
        types="MODULE types\n  RECORD piece\n    num width;\n  ENDRECORD\nENDMODULE\n",
    )
    assert it.texts == ["error 20135", "3"]


def test_routines_of_add_ins_are_no_unresolved_references(tmp_path: Path) -> None:
    it = ran_with(
        tmp_path,
        "OpenGripper;",
        r'Load "part.mod" \CheckRef;',
        "CheckProgRef;",
        assumes=True,
        part=PART,
    )
    assert (it.texts, it.end) == ([], "ended")


def test_a_call_of_what_nothing_declares_finds_a_loaded_module(tmp_path: Path) -> None:
    it = ran_with(
        tmp_path,
        "VAR num mine:=20;",
        "draw 1;",
        'Load "part.mod";',
        "draw mine;",
        r"draw 1\twice;",
        "n:=doubled(mine);",
        "told n;",
        "sum 3,mine;",
        "told mine;",
        assumes=True,
        part=PART.replace(
            "  FUNC", "  PROC sum(num x,INOUT num y)\n    y:=x+y;\n  ENDPROC\n  FUNC"
        ),
    )
    assert it.texts == ["30", "32", "40", "23"]
    assert it.run.unsimulated[0].name == "draw"  # The first time there was none.
    assert it.run.unsimulated[0].count == 1


def test_check_says_where_such_names_may_come_from() -> None:
    text = main('Load "part.mod";', "toled 1;", "draw 1;", "n:=doubled(1);", "n:=total;")
    found = load([SourceFile("cell.mod", text, "utf-8")]).diagnostics
    assert {one.severity for one in found} == {Severity.ERROR}
    late = "call a procedure of a loaded module by name: "
    assert [(one.violation.code, one.violation.help) for one in found] == [
        ("N209", f'did you mean `told`? Else {late}`%"toled"%`'),
        ("N209", f'{late}`%"draw"%`'),
        ("N209", "functions of loaded modules can be called where `check_references = false`"),
        ("N201", "read data of a module that is loaded while the program runs with GetDataVal"),
    ]


def test_what_a_loaded_module_may_have_or_use_is_not_held_missing_or_unused() -> None:
    wanted = (AmbiguousLateBinding, UnusedData, UnusedRoutine)
    rules = detectors_of(lambda rule: rule in {one.rule for one in wanted})
    for loading, expected in (('Load "part.mod";', set()), ("", set(wanted))):
        text = main(loading, '%"draw"% 3;')
        found = load([SourceFile("cell.mod", text, "utf-8")], rules).diagnostics
        assert {type(one.violation) for one in found} == expected, loading


def test_loaded_modules_share_persistents_with_other_tasks(tmp_path: Path) -> None:
    (tmp_path / "part.mod").write_text(PART)
    it = simulation_tasks.ran(
        {
            "T_ROB1": r"""
              PROC main()
                Load "part.mod";
                %"draw"% 5;
                WaitTime 1;
                UnLoad "part.mod";
              ENDPROC
              PROC told(num n)
                TPWrite "told "\Num:=n;
              ENDPROC
              VAR num count;""",
            "T_BACK": r"""
              PERS num total:=100;
              PROC main()
                WaitUntil total=105;
                TPWrite "seen";
                total:=7;
              ENDPROC""",
        },
        home=tmp_path,
    )
    assert [text for _, text in it.texts] == ["told 105", "seen"]
    assert it.end == "ended"


MOVE = """MODULE m
  VAR robtarget p:=[[9000,0,900],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    {loading}
    %"draw"%;
    MoveJ p,v100,fine,tool0;
  ENDPROC
ENDMODULE
"""


def test_what_a_loaded_module_may_write_is_not_known_to_check() -> None:
    assert checked(MOVE.replace("{loading}", ""), run=False).codes == [("K601", 6)]
    loading = checked(MOVE.replace("{loading}", 'Load "part.mod";'), run=False)
    assert (loading.codes, loading.counts) == ([], (0, 0, 1))


@pytest.mark.parametrize(("calls", "codes"), [((), []), (('%"draw"% 3;',), ["R104"])])
def test_unloading_says_where_a_controller_might_see_a_change(
    calls: tuple[str, ...], codes: list[str], tmp_path: Path
) -> None:
    unload = r'UnLoad \ErrIfChanged,"part.mod";'
    it = ran_with(tmp_path, 'Load "part.mod";', *calls, unload, part=PART)
    assert [code for code, _ in it.findings] == codes
    assert it.end == "ended"


def test_a_file_of_several_modules_is_not_saved(tmp_path: Path) -> None:
    two = PART + "MODULE other\nENDMODULE\n"
    it = ran_with(tmp_path, 'Load "part.mod";', r'UnLoad \Save,"part.mod";', part=two)
    assert it.texts == [f"error {ERR_UNLOAD:.0f}"]
    assert (tmp_path / "part.mod").read_text() == two
