"""Programs that work with files and folders as a whole, and with data by name."""

from datetime import datetime
from pathlib import Path

import numpy as np
from simulation_program import ran


def test_files_and_folders(tmp_path: Path) -> None:
    text = r"""MODULE cell
  VAR iodev file;
  VAR dir folder;
  VAR string name;
  PROC main()
    MakeDir "HOME:/log";
    Open "HOME:/log"\File:="a.txt",file\Write;
    Write file,"twelve chars";
    Close file;
    TPWrite ValToStr(FileSize("log/a.txt"));
    CopyFile "HOME:/log/a.txt","HOME:/log/b.txt";
    RenameFile "HOME:/log/b.txt","HOME:/c.txt";
    TPWrite ValToStr(IsFile("c.txt"))+ValToStr(IsFile("log"))+ValToStr(IsFile("log"\Directory));
    RemoveFile "log/a.txt";
    RemoveDir "log";
    OpenDir folder,"HOME:";
    WHILE ReadDir(folder,name) DO
      TPWrite name;
    ENDWHILE
    CloseDir folder;
  ENDPROC
ENDMODULE
"""
    it = ran(text, home=tmp_path)
    assert it.texts == ["13", "TRUETRUETRUE", ".", "..", "c.txt"]
    assert (tmp_path / "c.txt").read_text() == "twelve chars\n"
    assert it.run.home_files[0].path == str(tmp_path / "c.txt")
    assert [e.message for e in it.run.events if e.kind == "file"] == [
        "made the folder HOME:/log",
        "opened HOME:/log/a.txt to write",
        "copied HOME:/log/a.txt to HOME:/log/b.txt",
        "renamed HOME:/log/b.txt to HOME:/c.txt",
        "removed log/a.txt",
        "removed the folder log",
    ]


def test_a_binary_file_opened_without_a_mode_is_appended_to(tmp_path: Path) -> None:
    modes = (r"\Write\Bin", r"\Bin", r"\Append\Bin", r"\Write\Bin")
    each = "".join(
        f'    Open "a.bin",file{mode};\n    WriteBin file,bytes,2;\n    Close file;\n'
        '    TPWrite ValToStr(FileSize("a.bin"));\n'
        for mode in modes
    )
    text = (
        "MODULE cell\n  VAR iodev file;\n  VAR num bytes{2}:=[65,66];\n"
        f"  PROC main()\n{each}  ENDPROC\nENDMODULE\n"
    )
    assert ran(text, home=tmp_path).texts == ["2", "4", "6", "2"]


ERRORS = r"""MODULE cell
  VAR iodev file;
  VAR dir folder;
  VAR string name;
  VAR num n;
  VAR bool is;
  PROC main()
    Open "a.txt",file\Write;
    Close file;
    MakeDir "full";
    Open "full/b.txt",file\Write;
    Close file;
    {statement}
  ERROR
    TPWrite ValToStr(ERRNO={error});
    TRYNEXT;
  ENDPROC
ENDMODULE
"""


def test_what_the_disk_refuses_has_the_manuals_errors(tmp_path: Path) -> None:
    cases = (
        ('CopyFile "a.txt","full/b.txt";', "ERR_FILEEXIST"),
        ('RenameFile "a.txt","full/b.txt";', "ERR_FILEEXIST"),
        ('CopyFile "none.txt","c.txt";', "ERR_FILEACC"),
        ('RemoveFile "none.txt";', "ERR_FILEACC"),
        ('RemoveDir "full";', "ERR_FILEACC"),
        ('OpenDir folder,"none";', "ERR_FILEACC"),
        ("is:=ReadDir(folder,name);", "ERR_FILEACC"),
        ('n:=FileSize("none.txt");', "ERR_FILEACC"),
        ('MakeDir "full";', "ERR_FILEACC"),
        ('is:=IsFile("none.txt"\\RegFile);', "ERR_FILEACC"),
        ('Open "a.txt",file\\Append; n:=ReadNum(file);', "ERR_FILEACC"),
        ('Open "a.bin",file\\Write\\Bin; ReadAnyBin file,n;', "ERR_FILEACC"),
        ('Open "a.bin",file\\Append\\Bin; n:=ReadBin(file);', "ERR_FILEACC"),
        ('Open "a.txt",file\\Read; Write file,"x";', "ERR_FILEACC"),
    )
    for number, (statement, error) in enumerate(cases):
        home = tmp_path / str(number)
        home.mkdir()
        it = ran(ERRORS.format(statement=statement, error=error), home=home)
        assert it.texts == ["TRUE"], statement


def test_data_of_any_type_are_written_and_read_again(tmp_path: Path) -> None:
    text = r"""MODULE cell
  VAR iodev file;
  PERS tooldata gun:=[TRUE,[[1.5,2,3],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PROC main()
    VAR tooldata other;
    VAR num list{3}:=[0.1,2,3];
    VAR num again{3};
    VAR string s:="a\0Ab";
    Open "a.bin",file\Write\Bin;
    WriteAnyBin file,gun;
    WriteAnyBin file,list;
    WriteAnyBin file,s;
    Close file;
    s:="";
    Open "a.bin",file\Read\Bin;
    ReadAnyBin file,other;
    ReadAnyBin file,again;
    ReadAnyBin file,s;
    TPWrite ValToStr(other=gun)+ValToStr(again{1}=list{1})+ValToStr(s="a\0Ab");
    ReadAnyBin file,other;
  ERROR
    TPWrite ValToStr(ERRNO=ERR_RANYBIN_EOF);
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
    assert ran(text, home=tmp_path).texts == ["TRUETRUETRUE", "TRUE"]


def test_data_by_name() -> None:
    text = r"""MODULE cell
  PERS num rate1:=5;
  VAR num rate2:=6;
  CONST num rate3:=7;
  LOCAL VAR num rate4:=8;
  VAR num never;
  VAR num list{3}:=[1,2,3];
  PROC main()
    VAR num v;
    VAR num all{3};
    VAR string name;
    VAR datapos place;
    GetDataVal "RATE"+ValToStr(1),v;
    TPWrite ValToStr(v);
    v:=42;
    SetDataVal "never",v;
    TPWrite ValToStr(never);
    GetDataVal "list",all;
    all{2}:=20;
    SetDataVal "list",all;
    TPWrite ValToStr(list{2});
    SetDataSearch "num"\Object:="rate.*"\VarSym\PersSym\GlobalSym;
    WHILE GetNextSym(name,place) DO
      GetDataVal name\Block:=place,v;
      TPWrite name+" "+ValToStr(v);
    ENDWHILE
    v:=1;
    SetAllDataVal "num"\Object:="rate[1-4]",v;
    TPWrite ValToStr(rate1+rate2+rate3+rate4);
  ENDPROC
ENDMODULE
"""
    it = ran(text)
    assert it.texts == ["5", "42", "20", "rate1 5", "rate2 6", "10"]
    assert [(change.name, change.new) for change in it.run.persistents] == [("rate1", "1")]


def test_mistakes_with_names_have_the_manuals_errors() -> None:
    text = r"""MODULE cell
  CONST num fixed:=7;
  VAR num list{3};
  PROC main()
    VAR num v;
    VAR bool b;
    VAR num two{2};
    GetDataVal "nobody",v;
    GetDataVal "fixed",b;
    GetDataVal "list",v;
    SetDataVal "fixed",v;
    SetDataVal "list",two;
    SetDataSearch "num"\Object:="(";
  ERROR
    IF ERRNO=ERR_SYM_ACCESS TPWrite "access";
    IF ERRNO=ERR_SYMBOL_TYPE TPWrite "type";
    IF ERRNO=ERR_INVDIM TPWrite "size";
    IF ERRNO=ERR_ARGVALERR TPWrite "pattern";
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
    assert ran(text).texts == ["access", "type", "size", "access", "size", "pattern"]


def test_what_the_system_says_of_itself() -> None:
    text = r"""MODULE cell
  PERS tooldata gun:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  PERS tooldata now:=[TRUE,[[0,0,0],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  VAR intnum tick;
  CONST jointtarget start:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    CONNECT tick WITH on_tick;
    ITimer \Single,0.1,tick;
    WaitTime 0.2;
    TPWrite ValToStr(ExecLevel()=LEVEL_NORMAL);
    TPWrite ValToStr(ModExist("CELL"))+ValToStr(ModExist("other"));
    TPWrite GetSysInfo(\SystemName)+" "+GetSysInfo(\LanIp);
    MoveAbsJ start,v1000,fine,gun;
    GetSysData now;
    TPWrite ValToStr(now=gun)+ValToStr(EventType()=EVENT_NONE)+ValToStr(UIClientExist());
  ENDPROC
  TRAP on_tick
    TPWrite ValToStr(ExecLevel()=LEVEL_TRAP);
  ENDTRAP
ENDMODULE
"""
    assert ran(text).texts == ["TRUE", "TRUE", "TRUEFALSE", "rapidsim 127.0.0.1", "TRUETRUETRUE"]


def test_a_run_begins_at_the_date_it_is_given() -> None:
    text = r"""MODULE cell
  PROC main()
    WaitTime 90;
    TPWrite CDate()+" "+CTime()+" "+ValToStr(GetTime(\WDay))+" "+ValToStr(GetTime(\Min));
  ENDPROC
ENDMODULE
"""
    assert ran(text, starts_at=datetime(2024, 2, 28, 23, 59)).texts == ["2024-02-29 00:00:30 4 0"]
    assert ran(text).texts == ["2000-01-01 00:01:30 6 1"]


def test_other_disks_are_folders_of_the_home_folder(tmp_path: Path) -> None:
    text = r"""MODULE cell
  VAR iodev file;
  PROC main()
    Open "RAMDISK:"\File:="a.bin",file\Write;
    Write file,"ram";
    Close file;
    Open "C:/Users/me/b.txt",file\Write;
    Write file,"drive";
    Close file;
    Open "Home/c.txt",file\Write;
    Write file,"home";
    Close file;
    CopyFile "RAMDISK:/a.bin","TEMP:/a.bin";
    TPWrite ValToStr(IsFile("BACKUP:"\Directory))+ValToStr(IsFile("pc:/none"));
    Open "TEMP:/a.bin",file\Read;
    TPWrite ReadStr(file);
    Close file;
  ENDPROC
ENDMODULE
"""
    it = ran(text, home=tmp_path)
    assert it.texts == ["TRUEFALSE", "ram"]
    made = sorted(one.relative_to(tmp_path).as_posix() for one in tmp_path.rglob("*.*"))
    assert made == ["C/Users/me/b.txt", "RAMDISK/a.bin", "TEMP/a.bin", "c.txt"]


def test_the_size_of_the_disk_in_each_unit(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_bytes(bytes(1_500_000))
    asked = (r"\Total", r"\Free", r"\Total\Kbyte", r"\Free\Kbyte", r"\Total\Mbyte", r"\Free\Mbyte")
    each = "".join(f'    told FSSize("HOME:"{one});\n' for one in asked)
    it = ran(
        f"""MODULE cell
  PROC main()
{each}  ENDPROC
  PROC told(num size)
    TPWrite NumToStr(size,0);
  ENDPROC
ENDMODULE
""",
        home=tmp_path,
        assumes=True,
    )
    disk = 1_000_000_000
    free = disk - 1_500_000
    # Numbers of RAPID have single precision.
    whole = [disk, free, disk // 1024, free // 1024, disk // 1024**2, free // 1024**2]
    assert [float(text) for text in it.texts] == [float(np.float32(size)) for size in whole]
