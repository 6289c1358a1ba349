"""Programs that would hang, fill the memory or reach outside: a clear message and an exit code."""

from dataclasses import dataclass
from pathlib import Path

import pytest
from command_line import call

from rapidsim.controller.cell.home_folder import HomeFolder
from rapidsim.controller.journal import journal
from rapidsim.files import SourceFile
from rapidsim.interpreter.limits import array_bytes, element_bytes
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.errors import RapidError
from rapidsim.language.files import FileMode
from rapidsim.motion.robot.robot import load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate


@dataclass(frozen=True)
class Ended:
    code: int
    out: str


def run(text: str, folder: Path, *options: str) -> Ended:
    """Run a program in a folder of its own, with `outside` beside it."""
    work = folder / "work"
    work.mkdir()
    (folder / "outside").mkdir()
    (work / "job.mod").write_text(text, encoding="utf-8")
    # A run that its limits do not end shall fail its test, not the suite.
    least = ("run", "job.mod", "--no-record", "--max-wall", "120")
    ended = call(*least, *options, cwd=work, columns=200)
    return Ended(ended.code, ended.out + ended.err)


def main(body: str, declarations: str = "") -> str:
    return f"MODULE job\n{declarations}\n  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n"


def test_a_wait_on_a_signal_that_nobody_drives(tmp_path: Path) -> None:
    it = run(main("    WaitDI diNobody,1;"), tmp_path)
    assert it.code == 1
    assert "`diNobody` is waited for, but nothing will change it" in it.out
    assert "job.mod:4:5 in main" in it.out


def test_a_trap_storm(tmp_path: Path) -> None:
    text = """MODULE job
  VAR intnum changed;
  PROC main()
    CONNECT changed WITH again;
    ISignalDO doLamp,edge,changed;
    Set doLamp;
  ENDPROC
  TRAP again
    InvertDO doLamp;
  ENDTRAP
ENDMODULE
"""
    it = run(text, tmp_path)
    assert it.code == 1
    assert "trap-storm" in it.out


@pytest.mark.process  # Whose stack is its own.
def test_recursion_without_end(tmp_path: Path) -> None:
    text = (
        "MODULE job\n  PROC main()\n    again;\n  ENDPROC\n  PROC again()\n    again;\n  ENDPROC\n"
    )
    it = run(text + "ENDMODULE\n", tmp_path)
    assert it.code == 1
    assert "the stack overflowed in again" in it.out


LOOP = main("    FOR i FROM 1 TO 1000000000 DO\n      n:=n+1;\n    ENDFOR", "  VAR num n;")


def test_a_loop_of_a_thousand_million_turns_meets_the_time_limit(tmp_path: Path) -> None:
    it = run(LOOP, tmp_path, "--max-time", "20")
    assert it.code == 3
    assert "the time limit of 20 s was reached" in it.out
    assert "job.mod:4:5 in main" in it.out


def test_and_the_computers_clock_where_one_asks_for_that(tmp_path: Path) -> None:
    it = run(LOOP, tmp_path, "--max-wall", "0.2")
    assert it.code == 3
    assert "after 0.2 s on the computer's clock" in it.out


def test_a_million_elements_are_no_trouble(tmp_path: Path) -> None:
    it = run(
        main("    a{1000000}:=1;\n    TPWrite ValToStr(a{1000000});", "  VAR num a{1000000};"),
        tmp_path,
    )
    assert it.code == 0


def test_a_hundred_million_are_refused(tmp_path: Path) -> None:
    it = run(main("    a{1}:=1;", "  VAR num a{100000000};"), tmp_path)
    assert it.code == 1
    assert "more than 500 MB in all arrays" in it.out


def test_the_memory_of_an_array_is_that_of_its_elements() -> None:
    one = element_bytes(1.0)
    assert one > 8
    assert [array_bytes([1.0] * 5), array_bytes([[1.0] * 3, [1.0] * 3])] == [5 * one, 6 * one]
    assert array_bytes([[(1.0, 2.0)]]) == element_bytes((1.0, 2.0)) > 2 * one
    assert array_bytes([]) == 0


def test_texts_without_end_do_not_fill_the_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(journal, "MOST_EVENTS", 1000)
    body = '    WHILE TRUE DO\n      TPWrite "again";\n    ENDWHILE'
    loaded = load([SourceFile("job.mod", main(body), "utf-8")])
    assert loaded.program is not None
    it = simulate(loaded.program, load_robot("irb1600"), options=RunOptions())
    assert (it.end.value, len(it.events)) == ("time_limit", 1000)
    (found,) = it.diagnostics
    assert "1000 events are as many as it may note" in found.violation.message
    assert found.span is not None
    assert found.span.line == 5


WRITE = main('    Open "{path}",file\\Write;\n    Write file,"x";', "  VAR iodev file;")


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("../outside/a.txt", "lies outside the home folder"),
        ("HOME:/../../outside/a.txt", "lies outside the home folder"),
        ("HOME:/way_out/a.txt", "lies outside the home folder"),
        ("RAMDISK:/../../outside/a.txt", "lies outside the home folder"),
        ("C:/../../outside/a.txt", "lies outside the home folder"),
        ("com1:", "only disks are simulated"),
        ("//server:/share/a.txt", "only disks are simulated"),
    ],
)
def test_a_file_outside_the_home_folder(tmp_path: Path, path: str, message: str) -> None:
    home = tmp_path / "work" / "job.home"
    link = home / "way_out"
    text = WRITE.format(path=path)

    def prepared(folder: Path) -> Ended:
        made = folder / "home"
        made.mkdir()
        (made / "way_out").symlink_to(folder / "outside")
        return run(text, folder, "--home", str(made))

    it = prepared(tmp_path)
    assert it.code == 1
    assert message in it.out
    assert list((tmp_path / "outside").iterdir()) == []
    assert not link.exists()


def test_a_device_is_a_file_of_the_home_folder(tmp_path: Path) -> None:
    it = run(WRITE.format(path="/dev/null"), tmp_path)
    assert it.code == 0
    assert (tmp_path / "work" / "job.home" / "dev" / "null").read_text() == "x\n"


def test_no_instruction_leaves_the_home_folder(tmp_path: Path) -> None:
    home = tmp_path / "home"
    home.mkdir()
    (home / "a.txt").write_text("a")
    (home / "way_out").symlink_to(tmp_path / "outside")
    statements = (
        'CopyFile "a.txt","../outside/b.txt";',
        'RenameFile "a.txt","../outside/b.txt";',
        'RemoveFile "../work/job.mod";',
        'MakeDir "../outside/new";',
        'RemoveDir "../outside";',
        'OpenDir folder,"..";',
        'CopyFile "/way_out/secret.txt","b.txt";',
    )
    body = "\n".join(f"    {one}" for one in statements)
    handler = '\n  ERROR\n    TPWrite "refused "+ValToStr(ERRNO=ERR_FILEOPEN);\n    TRYNEXT;'
    it = run(main(body + handler, "  VAR dir folder;"), tmp_path, "--home", str(home))
    assert it.code == 0
    assert it.out.count("refused TRUE") == len(statements)
    assert list((tmp_path / "outside").iterdir()) == []
    assert (tmp_path / "work" / "job.mod").exists()
    assert sorted(one.name for one in home.iterdir()) == ["a.txt", "way_out"]


def test_a_socket_without_permission(tmp_path: Path) -> None:
    body = '    SocketCreate s;\n    SocketConnect s,"127.0.0.1",80;'
    it = run(main(body, "  VAR socketdev s;"), tmp_path)
    assert it.code == 1
    assert "nothing listens at 127.0.0.1:80 within 60 s" in it.out
    assert "--allow-network" in it.out


def test_the_disk_of_a_run_has_a_size(tmp_path: Path) -> None:
    home = HomeFolder(tmp_path)
    file = home.open_file("a.txt", FileMode.WRITE)
    home.open_file("b.txt", FileMode.WRITE).write(b"b" * 1000)
    with pytest.raises(RapidError, match="the disk is full"):
        file.write(bytes(1_000_000_000))
    home.close_all()


LOCAL_ARRAYS = """MODULE job
  PROC main()
    FOR i FROM 1 TO {times} DO
      again {depth};
    ENDFOR
  ENDPROC
  PROC again(num depth)
    VAR num a{{100000}};
    VAR string b{{300}};
    a{{1}}:=depth;
    IF depth>1 again depth-1;
    other;
  ENDPROC
  PROC other()
    VAR num a{{100000}};
    a{{1}}:=1;
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(("times", "depth", "code"), [(1, 1000, 1), (40, 10, 0)])
def test_arrays_of_active_routines_are_bounded(
    times: int, depth: int, code: int, tmp_path: Path
) -> None:
    """A thousand times 3.2 MB at once are too many; those of calls that have ended are not."""
    it = run(LOCAL_ARRAYS.format(times=times, depth=depth), tmp_path)
    assert it.code == code
    assert ("the stack overflowed in again" in it.out) == (code == 1)
