"""How much memory a file of less than a megabyte can make a command take.

Each file is checked and run in a process of its own, which the system ends beyond a limit.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

MOST_BYTES = 1_000_000_000
"""Of the resident memory of a command."""
_ADDRESSES = 4 * MOST_BYTES
"""Of addresses, of which libraries reserve more than they use."""
_TARGET = "[[600,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
_LIMITS = ("--no-record", "--max-wall", "20", "--max-time", "600")


@dataclass(frozen=True)
class Taken:
    """What a command took."""

    name: str
    command: str
    code: int
    megabytes: float
    message: str

    @property
    def is_sound(self) -> bool:
        """Whether it stayed below the limit and ended with a code of use."""
        return self.code in (0, 1, 2, 3, 4) and 1e6 * self.megabytes < MOST_BYTES


def _main(body: str, data: str = "") -> str:
    return f"MODULE m\n{data}\nPROC main()\n{body}\nENDPROC\nENDMODULE\n"


def files() -> Iterator[tuple[str, str]]:
    """Yield names and texts of modules that ask for much memory in few words."""
    arrays = {
        "numbers": ("num", "9E7", "1"),
        "many numbers": ("num", "15000000", "1"),
        "texts": ("string", "10000000", '"a"'),
        "targets": ("robtarget", "1000000", _TARGET),
        "tools": ("tooldata", "300000", "tool0"),
        "flags": ("bool", "50000000", "TRUE"),
    }
    for name, (kind, size, value) in arrays.items():
        size = str(int(float(size)))
        data = f"VAR {kind} a{{{size}}};\nVAR num n;"
        yield f"{name} untouched", _main("", data)
        yield f"{name} touched", _main(f"a{{1}}:={value};\na{{{size}}}:={value};", data)
        fill = f"FOR i FROM 1 TO {size} DO\na{{i}}:={value};\nENDFOR"
        yield f"{name} filled", _main(fill, data)
    yield "three dimensions", _main("a{1,1,1}.trans.x:=5;", "VAR robtarget a{1000,1000,9};")
    small = "\n".join(f"VAR num a{n}{{100000}};" for n in range(200))
    touch = "\n".join(f"a{n}{{1}}:=1;" for n in range(200))
    yield "many arrays", _main(touch, small)
    record = "RECORD r0\nrobtarget a;\nrobtarget b;\nENDRECORD\n" + "".join(
        f"RECORD r{n}\nr{n - 1} a;\nr{n - 1} b;\nENDRECORD\n" for n in range(1, 15)
    )
    yield "records in records", _main("x:=x;", f"{record}VAR r14 x;")
    yield "an array of them", _main("x{1}:=x{2};", f"{record}VAR r14 x{{100}};")
    deep = "PROC deep(num n)\nVAR num a{100000};\na{1}:=n;\nIF n<5000 deep n+1;\nENDPROC\n"
    yield "local arrays", _main("deep 1;").replace("ENDMODULE", f"{deep}ENDMODULE")
    yield "events", _main('WHILE TRUE DO\nTPWrite "again and again";\nENDWHILE')
    yield "signals", _main("WHILE TRUE DO\nInvertDO do1;\nENDWHILE")
    yield (
        "moves",
        _main(
            "FOR i FROM 1 TO 200000 DO\nMoveL Offs(p,i MOD 7,0,0),v1000,z1,tool0;\nENDFOR",
            f"CONST robtarget p:={_TARGET};",
        ),
    )
    yield (
        "one block",
        _main(
            "WHILE TRUE DO\nMoveJ p,v1000,z1,tool0;\nMoveJ Offs(p,9,0,0),v1000,z1,tool0;\nENDWHILE",
            f"CONST robtarget p:={_TARGET};",
        ),
    )
    yield (
        "recursion",
        _main("again 1;").replace("ENDMODULE", "PROC again(num n)\nagain n+1;\nENDPROC\nENDMODULE"),
    )
    yield "statements", _main("n:=n+1;\n" * 100_000, "VAR num n;")
    yield "expression", _main("n:=" + "(" * 50_000 + "1" + ")" * 50_000 + ";", "VAR num n;")
    yield "sum", _main("n:=1" + "+1" * 200_000 + ";", "VAR num n;")
    yield "names", "MODULE m\n" + "".join(f"VAR num n{n};\n" for n in range(60_000)) + "ENDMODULE\n"
    literal = ",".join(["1"] * 400_000)
    yield "literal", _main("", f"CONST num a{{400000}}:=[{literal}];")
    yield "marks", "[" * 900_000
    yield "errors", "MODULE m\n" + "IF ELSE ; ) \n" * 60_000
    yield (
        "raw bytes",
        _main(
            "WHILE TRUE DO\nPackRawBytes 1,r,RawBytesLen(r)+1\\Float4;\nENDWHILE", "VAR rawbytes r;"
        ),
    )
    yield (
        "file",
        _main(
            'Open "HOME:a.txt",f\\Write;\nFOR i FROM 1 TO 100000000 DO\nWrite f,"'
            + "x" * 70
            + '";\nENDFOR',
            "VAR iodev f;",
        ),
    )


def taken() -> Iterator[Taken]:
    """Check and run each file."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        for title, text in files():
            assert len(text) < 1_000_000, title
            (folder / "m.mod").write_text(text, encoding="utf-8")
            for command in (("check", "m.mod"), ("run", "m.mod", *_LIMITS)):
                yield _taken(title, command, folder)


def _taken(title: str, command: tuple[str, ...], folder: Path) -> Taken:
    child = (
        "import resource,sys;"
        f"resource.setrlimit(resource.RLIMIT_AS,({_ADDRESSES},)*2);"
        "from rapidsim.cli.boundary import run_commands;"
        "code=run_commands(sys.argv[1:]);"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,file=sys.stderr);"
        "sys.exit(code)"
    )
    done = subprocess.run(
        [sys.executable, "-c", child, *command],
        cwd=folder,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
        env={"RAPIDSIM_NO_CACHE": "1", "PATH": "", "OPENBLAS_NUM_THREADS": "1"},
    )
    *lines, last = done.stderr.splitlines() or [""]
    kilobytes = float(last) if last.isdigit() else 0.0
    message = next((line for line in lines if "error" in line), "")
    return Taken(title, command[0], done.returncode, kilobytes / 1000.0, message[:100])


def fuzz_memory() -> bool:
    """Try all files and print; whether none took too much."""
    is_sound = True
    for one in taken():
        mark = "" if one.is_sound else "  TOO MUCH"
        print(
            f"{one.name:22} {one.command:6} exit {one.code:3} {one.megabytes:7.0f} MB"
            f" {one.message}{mark}",
            flush=True,
        )
        is_sound &= one.is_sound
    return is_sound
