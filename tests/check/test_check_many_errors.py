"""Thousands of errors cost no more each than one."""

import pytest

from rapidsim.analysis.suggestions import closest
from rapidsim.files import SourceFile
from rapidsim.jobs.checking import error_free_subset
from rapidsim.jobs.checking.check_files import check_tasks
from rapidsim.jobs.checking.checked_program import load
from rapidsim.module_files import TaskFiles
from rapidsim.reach.checked_moves import ReachReport

COUNT = 300


def program(routines: int) -> str:
    move = "    MoveL [[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v10,z1,tGun;\n"
    body = move * (COUNT // routines)
    procs = "".join(f"  PROC p{k}()\n{body}  ENDPROC\n" for k in range(routines))
    return f"MODULE m\n{procs}ENDMODULE\n"


@pytest.mark.parametrize("routines", [1, 3])
def test_a_name_is_compared_once_in_a_routine(
    routines: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    compared: list[str] = []

    def counted(name: str, known: object) -> str | None:
        compared.append(name)
        return closest(name, known)  # type: ignore[arg-type]

    monkeypatch.setattr("rapidsim.analysis.context.closest", counted)
    found = load([SourceFile("m.mod", program(routines), "utf-8")]).diagnostics
    assert sum(one.code == "N201" for one in found) == COUNT
    assert len(compared) == 1 + routines


def test_a_routine_is_searched_once(monkeypatch: pytest.MonkeyPatch) -> None:
    searched: list[object] = []
    own_names = error_free_subset._own_names

    def counted(routine: object) -> frozenset[str]:
        searched.append(routine)
        return own_names(routine)  # type: ignore[arg-type]

    monkeypatch.setattr(error_free_subset, "_own_names", counted)
    tasks = [TaskFiles("T_ROB1", (SourceFile("m.mod", program(1), "utf-8"),))]
    result = check_tasks(tasks, (), lambda *_, **__: ReachReport())
    assert len(result.coverage.unchecked) == COUNT
    assert len(searched) == 1
