"""A mode that several routines set, and none puts back, is one note of the whole program."""

from pathlib import Path

from check_helper import found_in

from rapidsim.report.findings.merging import merged

PATHS = 5


def program(folder: Path, setting: str, more: str = "") -> Path:
    calls = "".join(f"    path{i};\n" for i in range(PATHS))
    paths = "".join(
        f"  PROC path{i}()\n    {setting}\n    MoveL Offs(p,0,0,{i}),v100,fine,tool0;\n  ENDPROC\n"
        for i in range(PATHS)
    )
    file = folder / "job.mod"
    file.write_text(
        "MODULE job\n  CONST robtarget p:=[[600,0,600],[0,0,1,0],[0,0,0,0],"
        "[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        f"  PROC main()\n    MoveJ p,v500,fine,tool0;\n{calls}{more}  ENDPROC\n{paths}ENDMODULE\n"
    )
    return file


def shown(file: Path) -> list[tuple[str, str]]:
    found = [one for one in found_in(file) if one.code == "F411"]
    return [(one.first.severity.value, one.first.message) for one in merged(found)]


def test_a_way_of_following_paths(tmp_path: Path) -> None:
    message = "`ConfL\\Off` is still in force when `path0` ends, as in 4 more routines"
    assert shown(program(tmp_path, r"ConfL\Off;")) == [("note", message)]


def test_a_speed_is_a_warning_each(tmp_path: Path) -> None:
    found = shown(program(tmp_path, "VelSet 50,1000;"))
    assert [severity for severity, _ in found] == ["warning"] * PATHS


def test_a_mode_that_is_put_back_somewhere(tmp_path: Path) -> None:
    found = shown(program(tmp_path, r"ConfL\Off;", "    ConfL\\On;\n"))
    assert [severity for severity, _ in found] == ["warning"] * PATHS
