"""A repository under test reaches no other files, and says nothing that a terminal obeys.

`docs/security.md` names these tests, line by line.
"""

import json
import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from rapidsim.cli import viewer
from rapidsim.cli.boundary import run_commands
from rapidsim.colours import LIGHT
from rapidsim.controller.cell import home_folder
from rapidsim.language.errors import RapidError
from rapidsim.language.files import FileMode

SECRET = "SECRET-OF-ANOTHER-FOLDER"
PROGRAM = 'MODULE job\n  PROC main()\n    TPWrite "done";\n  ENDPROC\nENDMODULE\n'
BROKEN = f"MODULE secret\n  VAR num x:={SECRET};\nENDMODULE\n"
WRITES = """MODULE job
  PROC main()
    VAR iodev file;
    Open "HOME:a.txt",file\\Append;
    Write file,"written";
    Close file;
  ENDPROC
ENDMODULE
"""

Ended = tuple[int, str, str]
Call = Callable[..., Ended]


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A checkout to work in, beside a folder that is none of its business."""
    outside, checkout = tmp_path / "outside", tmp_path / "checkout"
    outside.mkdir()
    checkout.mkdir()
    (outside / "secret.mod").write_text(BROKEN)
    (checkout / "job.mod").write_text(PROGRAM)
    monkeypatch.chdir(checkout)
    return checkout


@pytest.fixture
def call(capsys: pytest.CaptureFixture[str]) -> Call:
    def called(*arguments: str) -> Ended:
        code = run_commands(arguments)
        return code, *capsys.readouterr()

    return called


def refused(ended: Ended, part: str) -> None:
    code, out, err = ended
    assert code == 2
    assert part in err
    assert SECRET not in out + err


@pytest.mark.parametrize("target", ["..", "../outside", "."])
def test_a_default_home_folder_that_is_a_link_is_refused(
    here: Path, call: Call, target: str
) -> None:
    (here / "job.mod").write_text(WRITES)
    (here / "job.home").symlink_to(target)
    refused(call("run", "job.mod", "--no-record"), "job.home is a link")
    assert not list(here.parent.rglob("a.txt"))


def test_a_home_folder_that_is_named_may_be_a_link(here: Path, call: Call) -> None:
    (here / "job.mod").write_text(WRITES)
    (here / "elsewhere").symlink_to("../outside")
    assert call("run", "job.mod", "--no-record", "--home", "elsewhere")[0] == 0
    assert (here.parent / "outside" / "a.txt").read_text() == "written\n"


def test_links_to_themselves_in_the_home_folder_are_no_defect(here: Path, call: Call) -> None:
    (here / "job.mod").write_text(WRITES)
    (here / "job.home").mkdir()
    (here / "job.home" / "a.txt").symlink_to("a.txt")
    code, out, _ = call("run", "job.mod", "--no-record", "--home", "job.home")
    assert (code, "a link to itself" in out) == (1, True)


def test_a_link_to_itself_hides_no_way_out(here: Path) -> None:
    (here / "loop").symlink_to("loop")
    (here / "out").symlink_to("../outside")
    folder = home_folder.HomeFolder(here)
    for name in ("loop/../out/secret.mod", "loop", "loop/a", "out/secret.mod"):
        with pytest.raises(RapidError):
            folder.open_file(name, FileMode.READ)


def test_a_module_that_leads_out_is_refused_with_its_folder(here: Path, call: Call) -> None:
    (here / "link.mod").symlink_to("../outside/secret.mod")
    refused(call("check", "."), "link.mod leads out of .")
    refused(call("run", "."), "link.mod leads out of .")
    (here / "job.pgf").write_text("<Program><Module>link.mod</Module></Program>")
    refused(call("check", "job.pgf"), "link.mod leads out of .")


def test_a_module_that_is_named_may_be_a_link(here: Path, call: Call) -> None:
    (here / "link.mod").symlink_to("../outside/secret.mod")
    code, out, _ = call("check", "link.mod")
    assert (code, SECRET in out) == (1, True)


def test_links_inside_the_project_are_followed(here: Path, call: Call) -> None:
    (here / "cell").mkdir()
    (here / "cell" / "main.mod").symlink_to("../job.mod")
    refused(call("check", "cell"), "main.mod leads out of cell")
    (here / "rapidsim.toml").write_text("")
    assert call("check", "cell")[0] == 0


def test_task_folders_of_a_backup_that_lead_out_are_refused(here: Path, call: Call) -> None:
    (here / "RAPID").mkdir()
    (here / "RAPID" / "TASK1").symlink_to("../../outside")
    refused(call("check", "."), "leads out of .")


def test_a_configuration_that_leads_out_of_a_backup_is_refused(here: Path, call: Call) -> None:
    (here / "RAPID" / "TASK1").mkdir(parents=True)
    (here / "job.mod").rename(here / "RAPID" / "TASK1" / "job.mod")
    (here / "SYSPAR").mkdir()
    (here / "SYSPAR" / "EIO.cfg").symlink_to("../../outside/secret.mod")
    refused(call("check", "."), "EIO.cfg leads out of .")


@pytest.mark.parametrize("module", ["../outside/secret.mod", "../outside", "{outside}/secret.mod"])
def test_modules_of_a_station_file_lie_in_its_folder(here: Path, call: Call, module: str) -> None:
    named = module.format(outside=here.parent / "outside")
    (here / "rapidsim.toml").write_text(f'[[task]]\nmodules = ["{named}"]\n')
    refused(call("check", "job.mod"), "leads out of")


def test_modules_of_a_station_file_may_lie_where_the_command_line_says(
    here: Path, call: Call
) -> None:
    (here / "rapidsim.toml").write_text('[[task]]\nmodules = ["../outside/secret.mod"]\n')
    code, out, _ = call("check", "job.mod", "../outside")
    assert (code, SECRET in out) == (1, True)


@pytest.mark.parametrize("name", ["rapidsim.toml", "pyproject.toml"])
def test_settings_that_are_found_are_no_link_to_elsewhere(
    here: Path, call: Call, name: str
) -> None:
    (here.parent / "outside" / "set.toml").write_text(f"[tool.rapidsim]\n{SECRET} = 1\n")
    (here / name).symlink_to("../outside/set.toml")
    refused(call("check", "job.mod"), f"{name} leads out of")


@pytest.mark.parametrize("file", ["../outside/known.json", "{outside}/known.json", "link.json"])
def test_a_baseline_of_the_settings_lies_in_the_project(here: Path, call: Call, file: str) -> None:
    outside = here.parent / "outside"
    (here / "link.json").symlink_to("../outside/known.json")
    named = file.format(outside=outside)
    (here / "rapidsim.toml").write_text(f'[check]\nbaseline = "{named}"\n')
    refused(call("check", "job.mod", "--update-baseline"), "check.baseline")
    assert not (outside / "known.json").exists()


def test_a_baseline_of_the_settings_is_written_on_request_only(here: Path, call: Call) -> None:
    (here / "rapidsim.toml").write_text('[check]\nbaseline = "known.json"\n')
    refused(call("check", "job.mod"), "known.json does not exist")
    assert not (here / "known.json").exists()
    assert call("check", "job.mod", "--update-baseline")[0] == 0
    assert (here / "known.json").exists()
    assert call("check", "job.mod")[0] == 0


def test_what_is_no_baseline_is_not_written_over(here: Path, call: Call) -> None:
    (here / "rapidsim.toml").write_text('[check]\nbaseline = "job.mod"\n')
    refused(call("check", "job.mod", "--update-baseline"), "job.mod is not a baseline")
    assert (here / "job.mod").read_text() == PROGRAM


def test_fixes_and_values_never_leave_the_project(here: Path, call: Call) -> None:
    text = "module secret\nPERS num n:=1;\nPROC main()\nn:=2;\nENDPROC\nendmodule"
    outside = here.parent / "outside" / "secret.mod"
    outside.write_text(text)
    (here / "link.mod").symlink_to("../outside/secret.mod")
    call("check", ".", "--fix", "--unsafe-fixes", "--select", "S")
    call("run", ".", "--no-record", "--write-pers")
    assert outside.read_text() == text


def test_a_link_where_the_recording_goes_is_replaced(here: Path, call: Call) -> None:
    outside = here.parent / "outside" / "secret.mod"
    (here / "job.rrd").symlink_to(outside)
    assert call("run", "job.mod")[0] == 0
    assert outside.read_text() == BROKEN
    assert not (here / "job.rrd").is_symlink()


@pytest.mark.parametrize("kind", ["pipe", "device"])
def test_a_folder_with_a_pipe_or_device_is_refused(here: Path, call: Call, kind: str) -> None:
    if kind == "pipe":
        os.mkfifo(here / "b.mod")
    else:
        (here / "b.mod").symlink_to("/dev/zero")
    assert call("check", ".")[0] == 2


ODD = "a\\1B[31m\\9B2J\\07.txt"


def test_names_and_texts_of_programs_do_not_steer_a_terminal(here: Path, call: Call) -> None:
    (here / "job.mod").write_text(
        f'MODULE job\n  PROC main()\n    VAR iodev file;\n    Open "{ODD}",file\\Write;\n'
        f'    Close file;\n    TPWrite "{ODD}";\n    ErrWrite "{ODD}","\u202eabc";\n'
        f"    RAISE 14;\n  ENDPROC\nENDMODULE\n"
    )
    for arguments in (("run", "job.mod", "--no-record"), ("check", "job.mod")):
        for more in ((), ("-v",)):
            _, out, err = call(*arguments, *more)
            assert all(character.isprintable() or character == "\n" for character in out + err)
    _, out, _ = call("run", "job.mod", "--no-record", "--format", "json")
    assert "\x1b" not in out
    assert "a\x1b[31m" in json.dumps(json.loads(out), ensure_ascii=False).encode().decode(
        "unicode_escape"
    )


@pytest.mark.parametrize("form", ["full", "concise", "json", "sarif", "github", "junit"])
def test_no_output_of_check_steers_a_terminal(here: Path, call: Call, form: str) -> None:
    odd = here / "a\x1b[31m\u202eb.mod"
    odd.write_text(
        'MODULE m\n  PROC main()\n    x\x1b[2J:="\x9b31m\u2066";\n  ENDPROC\nENDMODULE\n'
    )
    code, out, err = call("check", odd.name, "--output-format", form)
    assert code == 1
    assert all(character.isprintable() or character in "\n\t" for character in out + err)


def test_what_the_station_file_names_does_not_steer_a_terminal(here: Path, call: Call) -> None:
    (here / "rapidsim.toml").write_text(
        '[signals]\n"a\\u001b[31m" = {}\n"\\u001b]0;x\\u0007" = 1\n'
    )
    _, out, err = call("run", "job.mod", "--no-record")
    assert err
    assert all(character.isprintable() or character == "\n" for character in out + err)


def test_a_program_makes_so_many_files_and_no_more(
    here: Path, call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(home_folder, "DISK_FILES", 20)
    (here / "job.mod").write_text(
        "MODULE job\n  PROC main()\n    VAR iodev file;\n    WHILE TRUE DO\n"
        '      MakeDir "d"+ValToStr(n);\n      Incr n;\n    ENDWHILE\n'
        "  ENDPROC\n  VAR num n;\nENDMODULE\n"
    )
    code, out, _ = call("run", "job.mod", "--no-record")
    assert (code, "may make 20 files and folders" in out) == (1, True)
    assert len(list((here / "job.home").iterdir())) == 19
    with pytest.raises(RapidError, match="may make 20 files"):
        home_folder.HomeFolder(here / "new").open_file("/".join("a" * 30), FileMode.WRITE)


def test_a_program_has_so_many_files_open_and_no_more(here: Path) -> None:
    folder = home_folder.HomeFolder(here)
    opened = [folder.open_file(f"{n}.txt", FileMode.WRITE) for n in range(100)]
    with pytest.raises(RapidError, match="100 files are open already"):
        folder.open_file("one more.txt", FileMode.WRITE)
    opened[0].close()
    folder.open_file("one more.txt", FileMode.WRITE)
    folder.close_all()


def test_one_place_prints() -> None:
    """Whatever is printed goes through `say` or `Terminal.show`."""
    sources = Path(__file__).parents[2] / "rapidsim"
    prints = ("click.echo(", "click.secho(", "print_exc(", "sys.stdout.write", " print(")
    found = {
        file.name
        for file in sources.rglob("*.py")
        if any(one in file.read_text(encoding="utf-8") for one in prints)
    }
    assert found <= {"terminal.py"}


def test_the_viewer_is_not_looked_for_in_the_working_directory(here: Path) -> None:
    (here / "rerun.py").write_text("raise SystemExit('obeyed')")
    done = subprocess.run(viewer._command(Path("--version")), capture_output=True, check=False)
    assert done.returncode == 0
    assert b"obeyed" not in done.stderr


def test_pictures_do_not_obey_a_file_in_the_working_directory() -> None:
    matplotlib = pytest.importorskip("matplotlib", reason="pictures need matplotlib")
    from rapidsim.plots.theme import themed  # noqa: PLC0415

    with matplotlib.rc_context({"text.usetex": True}), themed(LIGHT):
        assert not matplotlib.rcParams["text.usetex"]


def test_a_urdf_shows_nothing_of_a_file_that_is_none(here: Path, call: Call) -> None:
    urdf = here.parent / "outside" / "secret.urdf"
    urdf.write_text(BROKEN)
    (here / "rapidsim.toml").write_text(f'[robot]\nurdf = "{urdf}"\n')
    refused(call("run", "job.mod", "--no-record"), "not a readable URDF")


def test_save_stays_in_the_home_folder(here: Path, call: Call) -> None:
    (here / "job.mod").write_text(
        'MODULE job\n  PROC main()\n    Save "job" \\FilePath:="HOME:/../job2.mod";\n'
        "  ENDPROC\nENDMODULE\n"
    )
    assert call("run", "job.mod", "--no-record")[0] == 1
    assert not (here / "job2.mod").exists()
