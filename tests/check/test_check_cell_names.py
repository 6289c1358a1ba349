"""Names that a cell declares: known under any name, wherever the declaration stands, as their kind.

Signals of random names and kinds are declared in a station file, in the EIO.cfg of a backup or in a
file for `--io`, and stand in every place where RAPID takes a signal or its value.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from command_line import call
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.installed import (
    installed_data_names,
    installed_routine_names,
    installed_type_names,
)
from rapidsim.analysis.suggestions import reserved_words
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.module_files import Backup
from rapidsim.station.backup.backup import backup_station
from rapidsim.station.cell_names import declared_names
from rapidsim.station.read import read_io, read_station
from rapidsim.station.station import Station

KINDS = ("di", "do", "gi", "go", "ai", "ao")
TAKEN = {
    name.lower()
    for name in (
        *installed_data_names(),
        *installed_routine_names(),
        *installed_type_names(),
        *reserved_words(),
        *("main", "cell", "n", "b", "list", "take", "i", "given", "t", "rob_1", "t_rob1id", "k"),
        *("p", "trigg"),
        *(f"take_{kind}" for kind in KINDS),
    )
}
NAMES = st.from_regex(r"[A-Za-z][A-Za-z0-9_]{0,12}", fullmatch=True).filter(
    lambda name: name.lower() not in TAKEN
)
VALUES = (
    "n:={};",
    "n:=2*({}+1)-{};",
    "b:={}=1 OR NOT {}>2;",
    "IF {}=1 n:=1;",
    "IF {}<>0 THEN n:=1; ELSEIF {}=2 THEN n:=2; ENDIF",
    "WHILE {}>5 DO n:=1; ENDWHILE",
    "FOR k FROM {} TO 3 DO n:=k; ENDFOR",
    "TEST {} CASE 1: n:=1; DEFAULT: n:=2; ENDTEST",
    "WaitUntil {}=1 AND b;",
    "n:=list{{{}}};",
    "WaitTime {};",
    "n:=Abs({});",
    "n:=given({});",
)
"""Places that take the value of a signal of any kind."""
PLACES = {
    "di": (
        *("WaitDI {},1;", "b:=TestDI({});", "n:=DInput({});", "ISignalDI {},1,i;", "take_di {};"),
        *("WaitDI {},1\\MaxTime:=2;", "SearchL {},p,p,v100,tool0;"),
    ),
    "do": (
        *("SetDO {},1;", "Set {};", "Reset {};", "PulseDO {};", "InvertDO {};", "WaitDO {},0;"),
        *("n:=DOutput({});", "ISignalDO {},0,i;", "take_do {};"),
        *(
            "SetDO\\SDelay:=1,{},1;",
            "MoveLDO p,v100,fine,tool0,{},1;",
            "TriggIO trigg,5\\DOp:={},1;",
        ),
    ),
    "gi": ("WaitGI {},3;", "n:=GInput({});", "ISignalGI {},i;", "take_gi {};"),
    "go": (
        "SetGO {},3;",
        "WaitGO {},3;",
        "n:=GOutput({});",
        "ISignalGO {},i;",
        "take_go {};",
        "MoveJGO p,v100,fine,tool0,{}\\Value:=3;",
        "TriggIO trigg,5\\GOp:={},1;",
    ),
    "ai": ("n:=AInput({});", "WaitAI {}\\GT,3;", "take_ai {};"),
    "ao": (
        *("SetAO {},3;", "n:=AOutput({});", "take_ao {};"),
        *("MoveJAO p,v100,fine,tool0,{},3;", "TriggEquip trigg,5,0.1\\AOp:={},1;"),
    ),
}
"""Places that take a signal of one kind."""


def module(*statements: str) -> str:
    takes = "\n".join(f"PROC take_{kind}(VAR signal{kind} s)\nENDPROC" for kind in KINDS)
    body = "\n".join(statements)
    return (
        "MODULE cell\nVAR num n;\nVAR bool b;\nVAR num list{3};\nVAR intnum i;\n"
        "VAR robtarget p;\nVAR triggdata trigg;\n"
        f"PROC main()\nCONNECT i WITH t;\n{body}\nENDPROC\n"
        f"FUNC num given(num x)\nRETURN x;\nENDFUNC\nTRAP t\nENDTRAP\n{takes}\nENDMODULE\n"
    )


def in_station(folder: Path, signals: dict[str, str]) -> CellNames:
    file = folder / "rapidsim.toml"
    lines = (f'{name} = {{ type = "{kind}" }}' for name, kind in signals.items())
    file.write_text("\n".join(("[signals]", *lines)))
    return declared_names(read_station(file))


def by_io(folder: Path, signals: dict[str, str]) -> CellNames:
    in_station(folder, signals)
    return declared_names(Station(io=read_io(folder / "rapidsim.toml")))


def in_backup(folder: Path, signals: dict[str, str]) -> CellNames:
    lines = (
        f'      -Name "{name}" -SignalType "{kind.upper()}"\n' for name, kind in signals.items()
    )
    task = folder / "RAPID" / "TASK1"
    for made in (task, folder / "SYSPAR"):
        made.mkdir(parents=True, exist_ok=True)
    (folder / "SYSPAR" / "EIO.cfg").write_text("EIO_SIGNAL:\n" + "\n".join(lines))
    return declared_names(backup_station(Backup(folder, (task,))))


Declare = Callable[[Path, dict[str, str]], CellNames]
DECLARED = st.sampled_from((in_station, by_io, in_backup))


def found_in(text: str, names: CellNames) -> tuple[Diagnostic, ...]:
    return load([SourceFile("cell.mod", text, "utf-8")], cell=names).diagnostics


@given(
    declare=DECLARED,
    names=st.lists(NAMES, min_size=6, max_size=6, unique_by=str.lower),
    data=st.data(),
)
@examples(60)
def test_a_declared_signal_is_known_in_every_place_of_its_kind(
    tmp_path_factory: pytest.TempPathFactory,
    declare: Declare,
    names: list[str],
    data: st.DataObject,
) -> None:
    signals = dict(zip(names, KINDS, strict=True))
    statements = []
    for name, kind in signals.items():
        written = data.draw(st.sampled_from((name, name.upper(), name.lower())))
        statements += [place.format(*[written] * 3) for place in (*VALUES, *PLACES[kind])]
    found = found_in(module(*statements), declare(tmp_path_factory.mktemp("cell"), signals))
    assert not [(one.violation.code, one.violation.message) for one in found]


@given(
    declare=DECLARED,
    name=NAMES,
    kind=st.sampled_from(KINDS),
    other=st.sampled_from(KINDS),
    data=st.data(),
)
@examples(80)
def test_a_signal_of_another_kind_is_an_error_and_says_so(
    tmp_path_factory: pytest.TempPathFactory,
    declare: Declare,
    name: str,
    kind: str,
    other: str,
    data: st.DataObject,
) -> None:
    place = data.draw(st.sampled_from(PLACES[other]))
    names = declare(tmp_path_factory.mktemp("cell"), {name: kind})
    found = found_in(module(place.format(name)), names)
    errors = [one for one in found if one.severity is Severity.ERROR]
    assert bool(errors) == (kind != other), (place, kind)
    assert len(found) == len(errors) <= 1
    for one in errors:
        assert one.violation.code == "T301"
        assert f"declares `{name}` as signal{kind}" in (one.violation.help or "")


@given(declare=DECLARED, name=NAMES, kind=st.sampled_from(KINDS))
@examples(30)
def test_what_is_no_value_of_a_signal_is_an_error(
    tmp_path_factory: pytest.TempPathFactory, declare: Declare, name: str, kind: str
) -> None:
    names = declare(tmp_path_factory.mktemp("cell"), {name: kind})
    for wrong in (f"{name}:=1;", f'n:={name}+"a";', f"IF {name} n:=1;", f"TPWrite {name};"):
        codes = {one.violation.code for one in found_in(module(wrong), names)}
        assert codes & {"T301", "T313", "T318"}, wrong
        assert not codes & {"N201", "I801"}


@given(name=NAMES, kind=st.sampled_from(KINDS))
@examples(20)
def test_what_the_program_declares_hides_the_signal(
    tmp_path_factory: pytest.TempPathFactory, name: str, kind: str
) -> None:
    names = in_station(tmp_path_factory.mktemp("cell"), {name: kind})
    text = module(f'{name}:="a";').replace("VAR num n;", f"VAR num n;\nVAR string {name};")
    assert not found_in(text, names)


@pytest.mark.parametrize(
    ("name", "code"), [("gI_Select", "I801"), ("Di_ready", "I801"), ("gIselect", "N201")]
)
def test_a_prefix_of_its_kind_and_an_underscore_make_a_signal(
    name: str, code: str, tmp_path: Path
) -> None:
    file = tmp_path / "named.mod"
    file.write_text(
        f'MODULE named\n  PROC main()\n    IF {name}=1 TPWrite "on";\n  ENDPROC\nENDMODULE\n'
    )
    ended = call("check", str(file), "--output-format", "json", cwd=tmp_path)
    assert [one["code"] for one in json.loads(ended.out)["diagnostics"]] == [code]


@pytest.mark.parametrize(
    ("name", "codes"), [("DIPLC_Service", {"I801"}), ("DISTANCE_1", {"I801", "N201"})]
)
def test_a_name_that_begins_like_a_signal_of_the_program_is_one(name: str, codes: set[str]) -> None:
    text = module("WaitDI DIPLC_Ready,1;", f"IF {name}=1 Stop;")
    assert {one.violation.code for one in found_in(text, NO_CELL)} == codes


OF_THE_CONTROLLER = {
    "AUTO1": "di",
    "ENABLE2_4": "di",
    "MOTLMP": "do",
    "DRV1BRAKEOK": "di",
    "DRV2CHAIN1": "do",
    "SC1CBCREQ": "do",
    "LocalEmergencyStopStatus": "di",
    "c1ObjectsInQ": "go",
    "c3CountsPerSec": "ai",
}


@pytest.mark.parametrize("name", OF_THE_CONTROLLER)
def test_a_signal_that_the_controller_makes_is_there_whatever_is_configured(
    name: str, tmp_path: Path
) -> None:
    (tmp_path / "rapidsim.toml").write_text('[signals]\ndiGo = { type = "di" }\n')
    file = tmp_path / "shown.mod"
    file.write_text(
        f'MODULE shown\n  PROC main()\n    IF {name}=0 TPWrite "off";\n  ENDPROC\nENDMODULE\n'
    )
    ended = call("check", str(file), "--output-format", "json", cwd=tmp_path)
    (found,) = json.loads(ended.out)["diagnostics"]
    assert (found["code"], found["severity"]) == ("I801", "warning")
    assert f'{name} = {{ type = "{OF_THE_CONTROLLER[name]}" }}' in found["help"]
    assert "operator  0.000 s  off" in call("run", str(file), "--no-record", cwd=tmp_path).out


@pytest.mark.parametrize("name", ["auto1", "DRVBRAKEOK", "DRV1BRAKE2", "SC1CBC", "SCXCBCREQ"])
def test_what_is_only_like_one_is_not_declared(name: str, tmp_path: Path) -> None:
    file = tmp_path / "unlike.mod"
    file.write_text(
        f'MODULE unlike\n  PROC main()\n    IF {name}=0 TPWrite "off";\n  ENDPROC\nENDMODULE\n'
    )
    ended = call("check", str(file), "--output-format", "json", cwd=tmp_path)
    assert [one["code"] for one in json.loads(ended.out)["diagnostics"]] == ["N201"]


def test_an_instruction_decides_of_what_kind_it_is(tmp_path: Path) -> None:
    file = tmp_path / "waits.mod"
    file.write_text(
        "MODULE waits\n  PROC main()\n    WaitDI SC1CBCREQ,0\\MaxTime:=1;\n    SetDO MOTLMP,1;\n"
        "  ENDPROC\nENDMODULE\n"
    )
    (tmp_path / "rapidsim.toml").write_text('[signals]\ndiGo = { type = "di" }\n')
    ended = call("check", str(file), "--output-format", "json", cwd=tmp_path)
    found = {(one["code"], one["severity"]) for one in json.loads(ended.out)["diagnostics"]}
    assert found == {("I801", "warning")}


@pytest.mark.parametrize("kind", KINDS)
def test_a_signal_that_is_given_an_alias_is_of_its_kind(kind: str, tmp_path: Path) -> None:
    file = tmp_path / "alias.mod"
    file.write_text(
        "MODULE alias\n  PROC main()\n"
        f"    VAR signal{kind} other;\n    AliasIO glue,other;\n  ENDPROC\nENDMODULE\n"
    )
    ended = call("check", str(file), "--output-format", "json", cwd=tmp_path)
    told = json.loads(ended.out)["diagnostics"]
    (found,) = (one for one in told if one["code"] == "I801")
    assert f'glue = {{ type = "{kind}" }}' in found["help"]
