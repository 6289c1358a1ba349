"""Forty changes of a backup's configuration and forty layouts of it: named once, or not at all."""

import json
import random
from collections.abc import Callable
from pathlib import Path

import jsonschema
import pytest
from command_line import call

from rapidsim.api.schemas import json_schema

MAIN = """MODULE Main
  PERS tooldata tGrip:=[TRUE,[[0,0,150],[1,0,0,0]],[3,[0,0,70],[1,0,0,0],0,0,0]];
  PERS loaddata lPart:=[2,[0,0,50],[1,0,0,0],0,0,0];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[450,0,300],[0.7071068,0,0,0.7071068]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p:=[[0,0,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v100,fine,tGrip\\WObj:=wTable;
  ENDPROC
ENDMODULE
"""
FILES = {
    "RAPID/TASK1/PROGMOD/Main.mod": MAIN,
    "BACKINFO/backinfo.txt": """>>CREATION_DATE:
2026-01-02 03:04:05
>>PRODUCTS_ID:
RobotWare Version: 6.08.01.00
616-1 PC Interface
>>TASK1: (T_ROB1,Program,)
PROGMOD/Main.mod @
""",
    "SYSPAR/EIO.cfg": """EIO:CFG_1.0:6:1::
#
EIO_DEVICE:

      -Name "Board1" -Network "DeviceNet" -Address 10
#
EIO_SIGNAL:

      -Name "doGrip" -SignalType "DO" -Device "Board1" -DeviceMap "0" -Access "All"

      -Name "diClosed" -SignalType "DI" -Device "Board1" -DeviceMap "1" -Invert\\
      -FiltActive 20

      -Name "goJob" -SignalType "GO" -Device "Board1" -DeviceMap "8-11" -Default 3

      -Name "aoFlow" -SignalType "AO" -MaxLog 10 -MinLog -2.5
#
EIO_CROSS:

      -Name "c1" -Res "diClosed" -Act1 "doGrip" -Oper1 "AND" -Act2 "doRun"
#
SYSSIG_OUT:

      -Status "MotorOn" -Signal "doRun"

      -Status "Error" -Signal "doFault"
#
EIO_ACCESS:

      -Name "All" -Rapid -LocalManual
""",
    "SYSPAR/MOC.cfg": """MOC:CFG_1.0:6:0::
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_1600_1.2_6" -use_joint_0 "rob1_1"\\
      -base_frame_pos_x 0.5 -base_frame_orient_u0 1 -gravity_beta 0
#
ARM:

      -name "rob1_1" -lower_joint_bound -3.14159265 -upper_joint_bound 3.14159265

      -name "track" -lower_joint_bound 0 -upper_joint_bound 4
#
MOTOR_CALIB:

      -name "rob1_1" -valid_com_offset -com_offset 1.5 -cal_offset 2.0
#
ARM_LOAD:

      -name "r1_load_3" -mass 5 -mass_centre_x 0.1 -inertia_z 0.02
#
SINGLE:

      -name "track" -use_single_type "t" -use_joint "track" -base_frame_pos_z 0.25
#
SINGLE_TYPE:

      -name "t" -mechanics "TRACK"
#
JOINT:

      -name "track" -logical_axis 7 -use_arm "track"
""",
    "SYSPAR/SYS.cfg": """SYS:CFG_1.0:6:1::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask

      -Name "T_BACK" -Type "SEMISTATIC" -Entry "watch" -BindRef 0
#
CAB_TASK_MODULES:

      -File "HOME:/user.sys" -AllTask

      -File "HOME:/watch.mod" -Task "T_BACK"
""",
    "SYSPAR/PROC.cfg": """PROC:CFG_1.0:6:1::
#
ARC_SETTINGS:

      -name "arc1" -gas_preflow 0.5
""",
    "SYSPAR/SIO.cfg": """SIO:CFG_1.0:6:1::
#
COM_TRP:

      -Name "UCdevice" -Type "UDPUC" -RemoteAdress "192.168.1.5" -RemotePortNumber 6510
""",
    "rapidsim.toml": """[robot]
start = [0, 0, 0, 0, 30, 0]
[signals]
doExtra = { type = "do" }
[[stimulus]]
at = 2.0
set = { diClosed = 1 }
""",
}
EIO, MOC, SYS = ("SYSPAR/EIO.cfg", "SYSPAR/MOC.cfg", "SYSPAR/SYS.cfg")
PROC, SIO, RAPID = ("SYSPAR/PROC.cfg", "SYSPAR/SIO.cfg", "RAPID/TASK1/PROGMOD/Main.mod")
STATION, INFO = "rapidsim.toml", "BACKINFO/backinfo.txt"

CHANGES = (
    (EIO, '"DO" -Device', '"DI" -Device', "EIO_SIGNAL `doGrip`, SignalType: DO -> DI"),
    (EIO, '"DO" -Device "Board1"', '"DO" -Device "B2"', "`doGrip`, Device: Board1 -> B2"),
    (EIO, '-DeviceMap "0"', '-DeviceMap "5"', "EIO_SIGNAL `doGrip`, DeviceMap: 0 -> 5"),
    (EIO, '"8-11"', '"8-12"', "EIO_SIGNAL `goJob`, DeviceMap: 8-11 -> 8-12"),
    (EIO, '-Access "All"', '-Access "ReadOnly"', "`doGrip`, Access: All -> ReadOnly"),
    (EIO, " -Invert\\\n", "\\\n", "EIO_SIGNAL `diClosed`, Invert: true -> not set"),
    (EIO, "-FiltActive 20", "-FiltActive 50", "`diClosed`, FiltActive: 20 -> 50 ms"),
    (EIO, "-Default 3", "-Default 4", "EIO_SIGNAL `goJob`, Default: 3 -> 4"),
    (EIO, "-MinLog -2.5", "-MinLog -3", "EIO_SIGNAL `aoFlow`, MinLog: -2.5 -> -3"),
    (EIO, '-Oper1 "AND"', '-Oper1 "OR"', "EIO_CROSS `c1`, Oper1: AND -> OR"),
    (EIO, '-Act2 "doRun"', '-Act2 "doRun" -Act2_invert', "`c1`, Act2_invert: not set -> true"),
    (EIO, '-Res "diClosed"', '-Res "diOther"', "EIO_CROSS `c1`, Res: diClosed -> diOther"),
    (EIO, '"MotorOn" -Signal "doRun"', '"MotorOn" -Signal "doOn"', "Signal: doRun -> doOn"),
    (EIO, '"Error"', '"RunchOk"', "Status: Error -> RunchOk"),
    (EIO, "-Rapid -", "-", "EIO_ACCESS `All`, Rapid: true -> not set"),
    (EIO, "-Address 10", "-Address 12", "EIO_DEVICE `Board1`, Address: 10 -> 12"),
    (EIO, '-Name "goJob"', '-Name "goTask"', "EIO_SIGNAL `goJob`, Name: goJob -> goTask"),
    (
        EIO,
        '      -Name "aoFlow" -SignalType "AO" -MaxLog 10 -MinLog -2.5\n',
        "",
        "EIO_SIGNAL `aoFlow`: removed: SignalType AO, MaxLog 10, MinLog -2.5",
    ),
    (
        EIO,
        "-MinLog -2.5\n",
        '-MinLog -2.5\n      -Name "doNew" -SignalType "DO"\n',
        "EIO_SIGNAL `doNew`: added: SignalType DO",
    ),
    (MOC, "pos_x 0.5", "pos_x 0.75", "ROBOT `ROB_1`, base_frame_pos_x: 500 -> 750 mm"),
    (
        MOC,
        "orient_u0 1",
        "orient_u0 0.9961947\\\n      -base_frame_orient_u3 0.0871557",
        "base_frame_orient: [1,0,0,0] -> [0.9961947,0,0,0.0871557] (turned by 10.000 deg)",
    ),
    (MOC, "gravity_beta 0", "gravity_beta 1.570796327", "gravity_beta: 0 -> 90 deg"),
    (
        MOC,
        "-upper_joint_bound 3.14159265",
        "-upper_joint_bound 2.61799388",
        "ARM `rob1_1`, upper_joint_bound: 180 -> 150 deg",
    ),
    (MOC, "bound 4", "bound 5.5", "ARM `track`, upper_joint_bound: 4000 -> 5500 mm"),
    (MOC, "-cal_offset 2.0", "-cal_offset 2.5", "cal_offset: 114.591559 -> 143.239449 deg"),
    (MOC, "-mass 5", "-mass 6.5", "ARM_LOAD `r1_load_3`, mass: 5 -> 6.5 kg"),
    (MOC, "centre_x 0.1", "centre_x 0.2", "`r1_load_3`, mass_centre_x: 100 -> 200 mm"),
    (MOC, "inertia_z 0.02", "inertia_z 0.03", "inertia_z: 0.02 -> 0.03 kgm2"),
    (MOC, "1600_1.2_6", "1600_1.45_8", "use_robot_type: ROB1_1600_1.2_6 -> ROB1_1600_1.45_8"),
    (MOC, "pos_z 0.25", "pos_z 0.3", "SINGLE `track`, base_frame_pos_z: 250 -> 300 mm"),
    (SYS, '"SEMISTATIC"', '"STATIC"', "CAB_TASKS `T_BACK`, Type: SEMISTATIC -> STATIC"),
    (SYS, '-Entry "watch"', '-Entry "look"', "CAB_TASKS `T_BACK`, Entry: watch -> look"),
    (SYS, "-BindRef 0", "-BindRef 1", "CAB_TASKS `T_BACK`, BindRef: 0 -> 1"),
    (SYS, "user.sys", "other.sys", "File: HOME:/user.sys -> HOME:/other.sys"),
    (PROC, "preflow 0.5", "preflow 0.8", "ARC_SETTINGS `arc1`, gas_preflow: 0.5 -> 0.8"),
    (SIO, "6510", "6511", "COM_TRP `UCdevice`, RemotePortNumber: 6510 -> 6511"),
    (INFO, "6.08.01.00", "6.10.00.00", "product `RobotWare`: 6.08.01.00 -> 6.10.00.00"),
    (INFO, "616-1 PC Interface\n", "", "product `616-1 PC Interface`: removed: installed"),
    (STATION, "30, 0]", "45, 0]", "`robot`, start: [0, 0, 0, 0, 30, 0] -> [0, 0, 0, 0, 45, 0]"),
    (STATION, "at = 2.0", "at = 3.0", "at: 2 -> 3 s"),
    (RAPID, "[450,0,300]", "[455,0,300]", "user frame moved by 5.000 mm (x +5.000: 450 -> 455)"),
    (
        RAPID,
        "p:=[[0,0,0]",
        "p:=[[7,0,0]",
        "moved by 7.000 mm (x +7.000: 0 -> 7), in wTable; in the world by 7.000 mm "
        "(y +7.000: 0 -> 7)",
    ),
    (RAPID, "lPart:=[2", "lPart:=[2.5", "load `lPart`: mass 2 -> 2.5 kg"),
    (RAPID, "[0,0,50],[1,0,0,0],0", "[0,0,60],[1,0,0,0],0", "centre of gravity moved by 10.000 mm"),
    (RAPID, "0,0,0]];\n  PERS load", "0,0.4,0]];\n  PERS load", "tool `tGrip`: iy 0 -> 0.4 kgm2"),
)


def backup(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, newline="")


def changed(file: str, old: str, new: str) -> dict[str, str]:
    assert FILES[file].count(old) == 1, (file, old)
    return {**FILES, file: FILES[file].replace(old, new)}


def lines(out: str, *titles: str) -> list[str]:
    """The lines below some titles."""
    blocks = [block.splitlines() for block in out.split("\n\n")]
    return [line for block in blocks if block[0] in titles for line in block[1:]]


@pytest.mark.parametrize(
    ("file", "old", "new", "said"), CHANGES, ids=[f"{one[0]}-{one[2]}" for one in CHANGES]
)
def test_a_change_is_named_once(file: str, old: str, new: str, said: str, tmp_path: Path) -> None:
    backup(tmp_path / "a", FILES)
    backup(tmp_path / "b", changed(file, old, new))
    ended = call("diff", "a", "b", "--no-run", cwd=tmp_path)
    assert ended.code == 1
    named = lines(ended.out, "Configuration", "Program", "Cell")
    assert [said in line for line in named] == [True], ended.out
    back = call("diff", "b", "a", "--no-run", cwd=tmp_path)
    assert len(lines(back.out, "Configuration", "Program", "Cell")) == len(named)
    report = json.loads(call("diff", "a", "b", "--no-run", "--format", "json", cwd=tmp_path).out)
    jsonschema.validate(report, json_schema("diff"))
    assert len(report["configuration"]) + len(report["changes"]) == len(named)
    assert report["same"] is False
    for change in report["changes"]:
        assert all(one["old"] != one["new"] for one in change["values"])
        assert change["values"]


def test_values_of_data_are_given_component_by_component(tmp_path: Path) -> None:
    backup(tmp_path / "a", FILES)
    text = MAIN.replace("[0,0,150]", "[0,5,160]").replace("p:=[[0,0,0]", "p:=[[0,0,2.5]")
    backup(tmp_path / "b", {**FILES, RAPID: text.replace("v100", "v200")})
    report = json.loads(call("diff", "a", "b", "--no-run", "--format", "json", cwd=tmp_path).out)
    values = {change["name"]: change["values"] for change in report["changes"]}
    assert values == {
        "tGrip": [
            {"component": "tframe.trans.y", "old": 0.0, "new": 5.0, "unit": "mm"},
            {"component": "tframe.trans.z", "old": 150.0, "new": 160.0, "unit": "mm"},
        ],
        "p": [{"component": "trans.z", "old": 0.0, "new": 2.5, "unit": "mm"}],
        "v200": [{"component": "speed", "old": "v100", "new": "v200", "unit": ""}],
    }


def test_there_are_forty_changes() -> None:
    assert len(CHANGES) >= 40


Layout = Callable[[str, random.Random], str]


def _instances(text: str) -> list[list[str]]:
    """The types of a file: a header line and instances, continued lines joined."""
    blocks = [block.strip("\n") for block in text.split("#\n")]
    return [[block.split("\n")[0], *_joined(block)] for block in blocks]


def _joined(block: str) -> list[str]:
    text = "\n".join(block.split("\n")[1:]).replace("\\\n", " ")
    return [line.strip() for line in text.split("\n") if line.strip()]


def _written(blocks: list[list[str]]) -> str:
    lines = ([block[0], "", *(f"      {one}" for one in block[1:]), ""] for block in blocks)
    return "#\n".join(map("\n".join, lines))


def _shuffled(text: str, random_: random.Random) -> str:
    """Types, instances and attributes in another order."""
    header, *types = _instances(text)
    random_.shuffle(types)
    for block in types:
        instances = []
        for line in block[1:]:
            attributes = line.replace(" -", "\n-").split("\n")
            # A negative number is no attribute.
            parts: list[str] = []
            for one in attributes:
                if one[1:2].isdigit():
                    parts[-1] += f" {one}"
                else:
                    parts.append(one)
            random_.shuffle(parts)
            instances.append(" ".join(parts))
        random_.shuffle(instances)
        block[1:] = instances
    return _written([header, *types])


def _spaced(text: str, random_: random.Random) -> str:
    """Other indents, blank lines, ends of lines and continuations."""
    blocks = _instances(text)
    for block in blocks:
        block[1:] = [
            line.replace(" -", f"\\\n{' ' * random_.randrange(1, 9)}-", random_.randrange(3))
            if " -2" not in line
            else line
            for line in block[1:]
        ]
    return ("\n" * random_.randrange(3) + _written(blocks)).replace(
        "\n", random_.choice(("\n", "\r\n"))
    )


def _renumbered(text: str, random_: random.Random) -> str:
    """Numbers written in another way."""
    return (
        text.replace(" 0.5\n", " 5e-1\n")
        .replace("pos_x 0.5", "pos_x 0.5000")
        .replace("cal_offset 2.0", f"cal_offset {random_.choice(('2', '2.00', '+2.0', '20E-1'))}")
        .replace('"8-11"', random_.choice(('"8,9,10,11"', '"8-9,10-11"')))
        .replace('"DO"', "DO")
        .replace('-Name "doGrip"', '-name "doGrip"')
        .replace("-BindRef 0", "-bindref 0")
        .replace("-mass 5", "-mass 5.0")
    )


def _stamped(text: str, random_: random.Random) -> str:
    """Another header and other comments."""
    return f"# written on 2026-02-{random_.randrange(10, 28)}\n{text}".replace(":6:1::", ":6:2::")


LAYOUTS: tuple[Layout, ...] = (_shuffled, _spaced, _renumbered, _stamped)


@pytest.mark.parametrize("number", range(40))
def test_another_layout_is_no_change(number: int, tmp_path: Path) -> None:
    random_ = random.Random(number)
    files = dict(FILES)
    for layout in random_.sample(LAYOUTS, random_.randint(1, 3)):
        for name in files:
            if name.startswith("SYSPAR"):
                files[name] = layout(files[name].replace("\r", ""), random_)
    day = f"2026-03-{random_.randrange(10, 30)}"
    files[INFO] = files[INFO].replace("2026-01-02", day)
    files[STATION] = random_.choice(
        (
            FILES[STATION].replace("2.0", "2").replace(" = ", "=") + "# edited\n",
            '[[stimulus]]\nset.diClosed = 1.0\nat = 2\n[signals.doExtra]\ntype = "do"\n'
            "[robot]\nstart = [0.0, 0, 0, 0, 30.0, 0]\n",
        )
    )
    files[RAPID] = files[RAPID].replace("  PERS", "    pers").replace("450,0,300", "450.0, 0,3E2")
    backup(tmp_path / "a", FILES)
    backup(tmp_path / "b", files)
    ended = call("diff", "a", "b", "--no-run", cwd=tmp_path)
    assert (ended.code, ended.out) == (0, "No difference.\n"), files


def test_a_configuration_is_compared_without_a_program(tmp_path: Path) -> None:
    for side, files in (("a", FILES), ("b", changed(EIO, '"8-11"', '"8-12"'))):
        backup(tmp_path / side, {key: text for key, text in files.items() if "SYSPAR" in key})
    said = "  EIO: EIO_SIGNAL `goJob`, DeviceMap: 8-11 -> 8-12"
    for below in ("", "/SYSPAR", "/SYSPAR/EIO.cfg"):
        ended = call("diff", f"a{below}", f"b{below}", cwd=tmp_path)
        assert (ended.code, ended.out) == (1, f"Configuration\n{said}\n")
    assert call("diff", "a/SYSPAR/EIO.cfg", "a/SYSPAR/EIO.cfg", cwd=tmp_path).code == 0


def test_station_files_are_compared_alone(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(FILES[STATION])
    (tmp_path / "b.toml").write_text(FILES[STATION].replace("30, 0]", "40, 0]"))
    ended = call("diff", "a.toml", "b.toml", cwd=tmp_path)
    assert ended.code == 1
    assert ended.out == (
        "Configuration\n  station: `robot`, start: "
        "[0, 0, 0, 0, 30, 0] -> [0, 0, 0, 0, 40, 0] deg or mm\n"
    )


def test_what_one_side_lacks_is_said(tmp_path: Path) -> None:
    backup(tmp_path / "a", FILES)
    backup(tmp_path / "b", {"Main.mod": MAIN})
    backup(tmp_path / "c", {EIO: FILES[EIO]})
    said = call("diff", "a", "b", "--no-run", cwd=tmp_path).out
    assert "Configuration was not compared: b has none.\n" in said
    said = call("diff", "c", "a", "--no-run", cwd=tmp_path).out
    assert "Program was not compared: c has none.\n" in said
    marked = call("diff", "a", "b", "--no-run", "--format", "markdown", cwd=tmp_path).out
    assert "Configuration was not compared: b has none." in marked
    assert call("diff", "a", "nowhere", cwd=tmp_path).code == 2


def test_code_spans_of_markdown_are_left_alone(tmp_path: Path) -> None:
    old = MAIN.replace("MoveJ p", "IF a*2<b|c Stop;\n    MoveJ p")
    backup(tmp_path / "a", {"Main.mod": old})
    backup(tmp_path / "b", {"Main.mod": old.replace("b|c", "b|d")})
    marked = call("diff", "a", "b", "--no-run", "--format", "markdown", cwd=tmp_path).out
    assert "\\" not in marked
    backup(tmp_path / "a", {"Main.mod": MAIN.replace("MoveJ p", "nN:=2*nM;\n    MoveJ p")})
    backup(tmp_path / "b", {"Main.mod": MAIN.replace("MoveJ p", "nN:=3*nM;\n    MoveJ p")})
    marked = call("diff", "a", "b", "--no-run", "--format", "markdown", cwd=tmp_path).out
    assert "`nN:=2*nM;` -> `nN:=3*nM;`" in marked


def test_a_page_has_the_configuration(tmp_path: Path) -> None:
    backup(tmp_path / "a", FILES)
    backup(tmp_path / "b", changed(MOC, "bound 4", "bound 5.5"))
    options = ("--no-run", "--format", "html", "--output", "d.html")
    assert call("diff", "a", "b", *options, cwd=tmp_path).code == 1
    page = (tmp_path / "d.html").read_text(encoding="utf-8")
    assert "<code>track</code>, upper_joint_bound: 4000 -&gt; 5500 mm" in page
