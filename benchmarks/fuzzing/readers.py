"""Each kind of file that people hand over, its reader, and files to begin with.

A reader takes a file; whatever is in it, it returns or raises `InputError`.
"""

from __future__ import annotations

import io
import json
import random
import struct
import time
import traceback
import zipfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType

import rapidsim
from fuzzing.step_prism import step_prism
from rapidsim.analysis.passes.checker import check
from rapidsim.applications.calibrate.donation import read_donation
from rapidsim.applications.calibrate.joint_log import read_joint_log
from rapidsim.applications.diff.run_changes import ProgramRun, run_changes
from rapidsim.applications.diff.run_record import read_run_record
from rapidsim.applications.protocol.protocol import read_protocol
from rapidsim.backinfo import listed_products, listed_tasks
from rapidsim.collisions.meshes.read import read_mesh
from rapidsim.diagnostics import Source
from rapidsim.files import InputError, decode, input_bytes, input_text
from rapidsim.jobs.cache.finding_records import NoRecordError, read_findings
from rapidsim.jobs.cache.result_store import ResultStore
from rapidsim.jobs.checking.baseline import read_baseline
from rapidsim.jobs.inputs.answers import answers_of_file
from rapidsim.json_records.encoding import json_of
from rapidsim.module_files import module_names, read_tasks, single_programs
from rapidsim.motion.robot.urdf import robot_parts_from_urdf
from rapidsim.motion.waypoints.points_file import points_from_text
from rapidsim.report.run.json_report import course_report
from rapidsim.server.replay import replay_journal
from rapidsim.station.backup.cfg_file import read_configuration
from rapidsim.station.backup.standalone_configuration import loose_configuration
from rapidsim.station.read import read_io, read_station
from rapidsim.syntax.parser import parse

FAILURES = Path("fuzz-failures")
_TARGET = "[[600,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
_MODULE = f"""MODULE a
  CONST robtarget p10:={_TARGET};
  VAR num n{{3}}:=[1,2,3];
  PROC main()
    FOR i FROM 1 TO 3 DO
      IF n{{i}}>1 THEN MoveL Offs(p10,0,0,i),v100,z10,tool0\\WObj:=wobj0; ENDIF
    ENDFOR
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
_STATION = """[robot]
model = "irb1600-6-1.2"
base = { position = [0, 0, 10], quaternion = [1, 0, 0, 0] }
[[object]]
name = "table"
box = [100, 100, 100]
pose = { position = [3000, 0, 0] }
[signals]
di1 = { type = "di", value = 0 }
go1 = { type = "go", width = 8 }
[[stimulus]]
at = 0.3
every = 1.0
pulse = 0.2
set = { di1 = 1 }
[motion]
model = "3"
"""
_EIO = """EIO:CFG_1.0:6:0::
#
EIO_SIGNAL:

      -Name "di1" -SignalType "DI" -Device "board" -DeviceMap "0" -Access "All"
      -Name "go1" -SignalType "GO" -Device "board" -DeviceMap "0-7" -Default 3
#
EIO_CROSS:

      -Name "x" -Res "do1" -Act1 "di1" -Oper1 "AND" -Act2 "di2" -Act2_invert
"""
_MOC = """MOC:CFG_1.0:6:0::
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_1600_1.2_6" -base_frame_pos_x 0.1 -base_frame_orient_u0 1
#
ARM:

      -name "rob1_1" -upper_joint_bound 3.1 -lower_joint_bound -3.1
"""
_SYS = """SYS:CFG_1.0:6:0::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask -UseMechanicalUnitGroup "rob1"
#
CAB_TASK_MODULES:

      -File "HOME:/a.mod" -Task "T_ROB1" -Install
"""
_BACKINFO = """>>BackupInfo
>>SYSTEM_ID:
abc
>>PRODUCTS_ID:
RobotWare Base Option 6.08
>>TASK1: (T_ROB1,,)
SYSMOD/user.sys @
PROGMOD/a.mod @
"""
_GLTF = {
    "asset": {"version": "2.0"},
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "translation": [0, 0, 1]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 4}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [
        {
            "byteLength": 36,
            "uri": "data:application/octet-stream;base64,"
            "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
        }
    ],
}
_STL = (
    b"solid".ljust(80)
    + struct.pack("<I", 1)
    + struct.pack("<12fH", *range(3), 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
)
_SOLID = b"""solid a
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid
"""
_PLY = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
"""
_ON = '{"t":0,"kind":"event","what":{"kind":"on","motors":"motoron","opmode":"AUTO"}}\n'
_OFF = '{"t":1,"kind":"event","what":{"kind":"off"}}\n'
_DONATION = {
    "arm": "irb120-3-0.58",
    "robotware": None,
    "runs": [{"times_s": [0, 0.1], "joints_deg": [[0, 0, 0, 0, 30, 0]] * 2, "moves": []}],
}
_BASELINE = {
    "schema": 1,
    "motion_model": "3",
    "findings": [{"code": "I801", "routine": "main", "statement": "SetDO do1,1;", "count": 1}],
}
_LOG = "time,j1,j2,j3,j4,j5,j6\n" + "".join(f"{n / 10},0,0,0,0,30,{n}\n" for n in range(12))
_ARM = "".join(
    f"""<link name="l{n}"/><joint name="j{n}" type="revolute"><parent link="l{n - 1}"/>
<child link="l{n}"/><axis xyz="0 {n % 2} {1 - n % 2}"/><origin xyz="0 0 0.3" rpy="0 0 0"/>
<limit lower="-2" upper="2" velocity="1" effort="1"/></joint>"""
    for n in range(1, 4)
)
_URDF = f'<robot name="r"><link name="l0"/>{_ARM}</robot>'
_ANSWERS = "questions;2\nrobotware;7.8\nrobot;IRB 1600\n1;12.5\n2;TRUE\n"


def _archive() -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        archive.writestr("Backups/cell/RAPID/TASK1/PROGMOD/a.mod", _MODULE)
        archive.writestr("Backups/cell/SYSPAR/EIO.cfg", _EIO)
        archive.writestr("Backups/cell/BACKINFO/backinfo.txt", _BACKINFO)
    return data.getvalue()


@dataclass(frozen=True)
class Reader:
    """How a kind of file is read."""

    name: str
    """Of the file, whose suffix decides."""
    read: Callable[[Path], object]
    texts: tuple[bytes, ...]
    make: Callable[[], bytes] | None = None
    """Makes one more file, which takes longer."""
    cost: int = 1
    """Number of files of other kinds that are read in the time of one."""

    @property
    def seeds(self) -> tuple[bytes, ...]:
        """Files to begin with."""
        return self.texts if self.make is None else (*self.texts, self.make())


@cache
def _run() -> bytes:
    """A saved run."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "a.mod"
        file.write_text(_MODULE, encoding="utf-8")
        run = rapidsim.simulate([file], robot="irb1600")
        return json.dumps(json_of(course_report(run, run.diagnostics))).encode()


def _module(file: Path) -> None:
    (task,) = read_tasks([str(file)])
    parsed = [parse(Source(one.name, one.text)) for one in task.files]
    check([one.file for one in parsed])


def _saved_run(file: Path) -> None:
    text, _ = decode(input_bytes(file))
    try:
        report = json.loads(text)
    except (ValueError, RecursionError):
        return
    record = ProgramRun(read_run_record(report, str(file)))
    run_changes(record, record)


def _program_file(file: Path) -> None:
    module_names(file, input_bytes(file))
    read_tasks([str(file)])


def _back_info(file: Path) -> None:
    text, _ = decode(input_bytes(file))
    listed_products(text)
    listed_tasks(text)


def _configuration(file: Path) -> None:
    read_configuration(decode(input_bytes(file))[0])
    loose_configuration(file.parent)


def _stored_findings(file: Path) -> None:
    value = ResultStore(file.parent).value(file.stem)
    try:
        read_findings(value, [Source("a.mod", _MODULE)])
    except NoRecordError:
        return


def _backup(file: Path) -> None:
    for program in single_programs(str(file)):
        read_tasks([program])


def _texts(*texts: str) -> tuple[bytes, ...]:
    return tuple(text.encode() for text in texts)


def _mesh(file: Path) -> None:
    read_mesh(file, file.parent)


READERS: Mapping[str, Reader] = MappingProxyType(
    {
        "rapid": Reader("a.mod", _module, _texts(_MODULE)),
        "station": Reader("rapidsim.toml", read_station, _texts(_STATION)),
        "io": Reader(
            "io.toml",
            read_io,
            _texts("[signals]" + _STATION.partition("[signals]")[2].partition("[motion]")[0]),
        ),
        "stl": Reader("a.stl", _mesh, (_STL, _SOLID)),
        "obj": Reader("a.obj", _mesh, _texts("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -1\n")),
        "ply": Reader("a.ply", _mesh, _texts(_PLY)),
        "step": Reader("a.step", _mesh, _texts(step_prism(((0, 0), (2, 0), (0, 1)), 3)), cost=50),
        "gltf": Reader("a.gltf", _mesh, _texts(json.dumps(_GLTF))),
        "eio": Reader("EIO.cfg", _configuration, _texts(_EIO)),
        "moc": Reader("MOC.cfg", _configuration, _texts(_MOC)),
        "sys": Reader("SYS.cfg", _configuration, _texts(_SYS)),
        "back info": Reader("backinfo.txt", _back_info, _texts(_BACKINFO)),
        "packed": Reader("a.rspag", _backup, (_archive(),)),
        "program": Reader(
            "a.pgf", _program_file, _texts("<Program><Module>a.mod</Module></Program>")
        ),
        "urdf": Reader("a.urdf", robot_parts_from_urdf, _texts(_URDF)),
        "points": Reader(
            "a.csv",
            lambda file: points_from_text(input_text(file), file.name, 6),
            _texts(
                "x,y,z,q1,q2,q3,q4\n1,2,3,1,0,0,0\n", "x_mm;y;z;pitch;knot\n1;2;3;4;5\n2;2;3;4;6\n"
            ),
        ),
        "log": Reader(
            "a.csv",
            lambda file: read_joint_log(file, 6),
            _texts(_LOG),
        ),
        "donation": Reader("a.json", read_donation, _texts(json.dumps(_DONATION))),
        "run": Reader("a.json", _saved_run, (), _run),
        "baseline": Reader(
            "a.json",
            read_baseline,
            _texts(json.dumps(_BASELINE)),
        ),
        "journal": Reader("a.jsonl", replay_journal, _texts(_ON + _OFF)),
        "cache": Reader("a.json", _stored_findings, _texts('[[["a.mod",null]],[[],[]]]')),
        "answers": Reader("a.txt", lambda file: answers_of_file(str(file)), _texts("1\nyes\n")),
        "protocol": Reader("a.txt", read_protocol, _texts(_ANSWERS)),
    }
)
"""Readers by the kind of file."""


class Tried:
    """A reader and a folder for its file."""

    def __init__(self, reader: Reader, folder: Path) -> None:
        """Put other files that it may name beside its file."""
        self._read, self._file = reader.read, folder / reader.name
        if reader.name.endswith(".pgf"):
            (folder / "a.mod").write_text(_MODULE, encoding="utf-8")

    def __call__(self, data: bytes) -> None:
        """Read a file of these bytes; only what is no error of its user passes."""
        self._file.write_bytes(data)
        try:
            self._read(self._file)
        except InputError:
            return


def changed(data: bytes, dice: random.Random, others: tuple[bytes, ...]) -> bytes:
    """Bytes with a few cut, doubled, changed, exchanged for some of another file or for many 9."""
    for _ in range(dice.randrange(1, 6)):
        start = dice.randrange(len(data) + 1)
        stop = start + dice.choice((0, 1, 1, 2, 8, 40))
        other = dice.choice(others)
        at = dice.randrange(len(other) + 1)
        odd = (b"", dice.randbytes(1), dice.randbytes(4), b"9" * 20)
        new = dice.choice((*odd, other[at : at + 30], data[start:stop] * 2))
        data = data[:start] + new + data[stop:]
    return data


def damaged(kind: str, count: int, seed: int) -> Iterator[bytes]:
    """Yield the files that a reader begins with, and damaged ones."""
    seeds, dice = READERS[kind].seeds, random.Random(f"{kind} {seed}")
    yield from seeds
    for _ in range(count // READERS[kind].cost):
        yield changed(dice.choice(seeds), dice, seeds)


def read_damaged(kind: str, count: int, seed: int) -> None:
    """Let a reader read damaged files.

    Raises:
        Exception: Whatever a reader raises that is no error of its user.
    """
    with TemporaryDirectory() as folder:
        tried = Tried(READERS[kind], Path(folder))
        for data in damaged(kind, count, seed):
            tried(data)


def fuzz_files(count: int, seed: int) -> bool:
    """Damage files of all kinds, keep what is not refused in words, and print."""
    failures = 0
    for kind in READERS:
        begin, known = time.process_time(), set[str]()
        with TemporaryDirectory() as folder:
            tried = Tried(READERS[kind], Path(folder))
            for data in damaged(kind, count, seed):
                try:
                    tried(data)
                except Exception as error:
                    signature = signature_of(kind, error)
                    if signature not in known:
                        keep(signature, data)
                        print(f"{signature}\n{traceback.format_exc(limit=-4)}", flush=True)
                    known.add(signature)
        failures += len(known)
        seconds = time.process_time() - begin
        print(f"{kind:10} {count} files, {seconds:.0f} s, {len(known)} failures", flush=True)
    return not failures


def signature_of(kind: str, error: Exception) -> str:
    """Where a reader failed; failures with one signature have one cause."""
    frame = traceback.extract_tb(error.__traceback__)[-1]
    return f"{kind} {type(error).__name__} {Path(frame.filename).name} {frame.lineno}"


def keep(signature: str, data: bytes) -> None:
    """Keep a file that a reader did not refuse in words."""
    FAILURES.mkdir(exist_ok=True)
    (FAILURES / signature.replace(" ", "_")).write_bytes(data)
