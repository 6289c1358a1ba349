"""A mistake at which a controller stops or refuses is green nowhere.

Ten kinds of mistake in five programs, without an ERROR clause and within three kinds of them: by
`check`, by `run`, in Python and on a served controller. None of them may count as success, and the
three that name a finding name the same one.
"""

import json
import shutil
from itertools import product
from pathlib import Path

import pytest
from command_line import call
from laws import some

import rapidsim
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import ProgramRejectedError
from rapidsim.server.loading import ready
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.event_log import LogEntry

PROGRAMS = Path(__file__).parents[2] / "programs"
CELLS = {
    "circle": ("circle.mod", "circle.mod"),
    "cell": ("cell", "PickAndPlace.mod"),
    "tested": ("tested", "stack.mod"),
    "tending": ("machine_tending", "Tending.mod"),
    "two_robots": ("two_robots", "Left.mod"),
}
MISTAKES = {
    "out of reach": ("MoveJ kFar,v100,fine,tool0;", "K601"),
    "line out of reach": ("MoveL Offs(kNear,0,0,5000),v100,fine,tool0;", "K601"),
    "limit": ("MoveAbsJ kLimit,v100,fine,tool0;", "K602"),
    "configuration": ("MoveJ kOther,v100,fine,tool0;", "K603"),
    "orientation": ("MoveJ kNone,v100,fine,tool0;", "M501"),
    "no circle": ("MoveC kNear,kNear,v100,fine,tool0;", "M506"),
    "undeclared routine": ("pick_prt;", "N209"),
    "undeclared function": ("reg1:=Frobnicate(3);", "N209"),
    "undeclared tool": ("MoveJ kNear,v100,fine,tNone;", "N201"),
    "misspelt instruction": ("MovJ kNear,v100,fine,tool0;", "N209"),
}
CLAUSES = {
    "none": ("", ""),
    "next": ("  ERROR\n    TRYNEXT;\n", ""),
    "again": ("  ERROR\n    reg5:=reg5+1;\n    IF reg5<3 RETRY;\n    RETURN;\n", ""),
    "caller": ("", "  ERROR\n    RETURN;\n"),
}
_UNUSED = "[9E9,9E9,9E9,9E9,9E9,9E9]"
DATA = f"""    CONST robtarget kNear:=[[800,0,800],[0,0,1,0],[0,0,0,0],{_UNUSED}];
    CONST robtarget kFar:=[[9000,0,800],[0,0,1,0],[0,0,0,0],{_UNUSED}];
    CONST robtarget kOther:=[[800,0,800],[0,0,1,0],[0,0,0,3],{_UNUSED}];
    CONST robtarget kNone:=[[800,0,800],[0,0,0,0],[0,0,0,0],{_UNUSED}];
    CONST jointtarget kLimit:=[[0,0,0,0,130,0],{_UNUSED}];
    ConfJ\\On;
    ConfL\\On;
"""
CASES = list(product(MISTAKES, CLAUSES, CELLS))


def planted(mistake: str, clause: str, cell: str, folder: Path) -> Path:
    """A copy of a cell whose main first calls a routine with a mistake in it."""
    name, file = CELLS[cell]
    source = PROGRAMS / name
    (shutil.copytree if source.is_dir() else shutil.copyfile)(source, folder / name)
    module = folder / name / file if source.is_dir() else folder / name
    text = module.read_text()
    inner, outer = CLAUSES[clause]
    first = (
        "    MoveJ kNear,v500,fine,tool0;\n"
        if mistake in ("line out of reach", "no circle")
        else ""
    )
    routines = (
        f"  PROC guarded()\n    planted;\n{outer}  ENDPROC\n"
        f"  PROC planted()\n{DATA}{first}    {MISTAKES[mistake][0]}\n{inner}  ENDPROC\nENDMODULE"
    )
    head, _, rest = text.partition("  PROC main()\n")
    rest = "    guarded;\n" + rest[: rest.rindex("ENDMODULE")] + routines + "\n"
    module.write_text(f"{head}  PROC main()\n{rest}")
    for other in module.parent.glob("*.mod"):
        # Variants of the same cell would be a second main.
        if source.is_dir() and cell == "tending" and other != module:
            other.unlink()
    return module if cell == "tested" else folder / name


def first_error(printed: str) -> tuple[str, str, int]:
    found = json.loads(printed)["diagnostics"]
    errors = [one for one in found if one["severity"] == "error" and one["code"][0] != "C"]
    first = errors[0]
    return first["code"], first["message"], first["line"]


@pytest.mark.parametrize(("mistake", "clause", "cell"), some(CASES, 13))
def test_no_door_is_green(mistake: str, clause: str, cell: str, tmp_path: Path) -> None:
    program = planted(mistake, clause, cell, tmp_path)
    arm = ("--robot", "irb1600") if cell == "circle" else ()
    checked = call("check", program, "--output-format", "json", *arm, cwd=tmp_path)
    ran = call("run", program, "--no-record", "--format", "json", *arm, cwd=tmp_path)
    assert (checked.code, ran.code) == (1, 1)
    assert not json.loads(checked.out)["ok"]
    assert not json.loads(ran.out)["ok"]
    assert first_error(checked.out)[0] == MISTAKES[mistake][1]
    assert first_error(ran.out) == first_error(checked.out)

    loaded = rapidsim.load(program, robot="irb1600" if cell == "circle" else None)
    assert not loaded.check().ok
    is_refused = MISTAKES[mistake][1].startswith("N")
    asked = RunRequest(paths=(str(program),), robot="irb1600" if cell == "circle" else None)
    if is_refused:
        with pytest.raises(ProgramRejectedError):
            loaded.run()
        with pytest.raises(ProgramRejectedError):
            ready(asked)
        return
    run = loaded.run()
    assert (run.ok, run.end) == (False, "error")
    served = ready(asked)
    entries: list[LogEntry] = []
    controller = LiveController(served.setups, served.options, entries.append)
    controller.start()
    controller.advance(30.0)
    assert not controller.executes
    assert any(entry.type == 3 for entry in entries)


def test_a_warning_does_not_stand_for_an_error_of_the_same_words(tmp_path: Path) -> None:
    program = planted("orientation", "none", "cell", tmp_path)
    checked = call("check", program, "--output-format", "concise", cwd=tmp_path)
    found = [line.partition(" ")[2] for line in checked.out.splitlines() if "M501" in line]
    message = "[M501] the orientation of `kNone` has length 0.0000, not 1"
    assert found == [f"error{message}", f"warning{message}"]


def test_a_main_with_parameters_is_not_run(tmp_path: Path) -> None:
    file = tmp_path / "m.mod"
    file.write_text(
        "MODULE m\n  PROC main(num a)\n    VAR num b;\n    b:=1/a;\n  ENDPROC\nENDMODULE\n"
    )
    assert rapidsim.check([file]).ok
