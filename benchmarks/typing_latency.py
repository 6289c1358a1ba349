"""Time of a workspace from a keystroke to the new findings, on generated tasks.

Prints processor times in milliseconds, of the process alone: an edit within a routine, a value of a
declaration, a line of declarations, a header of a routine, what is half typed, and typing the
programs of a cell anew.
Run it on an idle machine: `python benchmarks/typing_latency.py`.
"""

from __future__ import annotations

import random
import re
import resource
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path

from rapidsim.files import SourceFile, decode
from rapidsim.module_files import TaskFiles
from rapidsim.syntax.garbage_collection import gc_rarely
from rapidsim.workspace.changes import TextChange
from rapidsim.workspace.workspace import Workspace

EDITS = 200
CELL = Path(__file__).parents[1] / "programs" / "cell"
OPENER = re.compile(r"\s*(?:LOCAL )?(PROC|FUNC|TRAP)\b")
CLOSER = re.compile(r"\s*END(?:PROC|FUNC|TRAP)\b")


def module(name: str, lines: int, seed: int) -> str:
    """A module of about so many lines: targets, data, and routines that move and wait."""
    rng = random.Random(seed)
    count = lines // 50
    text = [f"MODULE {name}"]
    for k in range(count):
        place = f"[{rng.randint(300, 900)},{rng.randint(-400, 400)},{rng.randint(200, 900)}]"
        rest = "[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]"
        text += [f"  CONST robtarget p{name}{k}:=[{place},{rest}];", f"  VAR num n{name}{k}:={k};"]
    number = 0
    while len(text) < lines:
        text += ["", f"  PROC r{name}{number}(num count)", "    VAR num i;"]
        for _ in range(rng.randint(6, 24)):
            target = f"p{name}{rng.randrange(count)}"
            text += rng.choice(
                [
                    [f"    MoveL {target},v{rng.choice([100, 200, 500])},fine,tool0;"],
                    [f"    MoveL Offs({target},0,0,{rng.randint(1, 100)}),v100,z10,tool0;"],
                    [f"    SetDO do{rng.randint(1, 9)}_x,{rng.randint(0, 1)};"],
                    [f"    WaitDI di{rng.randint(1, 9)}_x,1;"],
                    [f"    i:=i+count*n{name}{rng.randrange(count)};"],
                    ["    IF i>3 THEN", f"      n{name}0:=i;", "    ENDIF"],
                    [f"    r{name}{rng.randrange(number)} {rng.randint(1, 9)};"] if number else [],
                ]
            )
        text.append("  ENDPROC")
        number += 1
    return "\n".join([*text, "ENDMODULE", ""])


def task(modules: int, lines: int) -> dict[str, str]:
    """The texts of a task."""
    texts = {f"m{k}.mod": module(f"M{k}_", lines, k) for k in range(modules)}
    calls = "".join(f"    rM{k}_0 1;\n" for k in range(modules))
    main = f"MODULE MainModule\n  PROC main()\n{calls}  ENDPROC\nENDMODULE\n"
    return {**texts, "main.mod": main}


def opened(texts: Mapping[str, str]) -> Workspace:
    """A workspace of one task."""
    files = tuple(SourceFile(path, text, "utf-8") for path, text in texts.items())
    return Workspace([TaskFiles(None, files)])


def cpu_ms() -> float:
    """Processor time of this process so far."""
    return time.process_time() * 1000.0


def in_routine(rng: random.Random, text: str) -> TextChange:
    """A character in a routine, or a line of it once more."""
    at = text.index("\n", rng.randrange(text.index("PROC"), len(text) - 60)) + 1
    while text[at:].lstrip()[:4] in ("PROC", "ENDP", "VAR "):
        at = text.index("\n", at) + 1
    if rng.random() < 0.5:
        return TextChange(at, at, rng.choice([" ", "x"]))
    return TextChange(at, at, text[at : text.index("\n", at) + 1])


def in_value(rng: random.Random, text: str) -> TextChange:
    """A digit more in the value of a declaration."""
    at = text.index(";", rng.randrange(text.index("PROC") - 200))
    return TextChange(at, at, "") if text[at - 1] == "]" else TextChange(at, at, "1")


def of_declarations(rng: random.Random, text: str) -> TextChange:
    """One more declaration."""
    at = text.index("\n", rng.randrange(text.index("PROC") - 200)) + 1
    return TextChange(at, at, f"  VAR num another{rng.randrange(1000)};\n")


def of_headers(rng: random.Random, text: str) -> TextChange:
    """A letter more in the name of a routine, or a parameter more."""
    at = text.index("(num count)", rng.randrange(text.index("PROC"), len(text) - 1000))
    return TextChange(at, at, "x") if rng.random() < 0.5 else TextChange(at + 1, at + 1, "num n,")


def measure(
    cell: Workspace, title: str, edit: Callable[[random.Random, str], TextChange], count: int
) -> None:
    """Make edits, each of which is taken back, and print the times of both."""
    rng = random.Random(3)
    times: list[float] = []
    local = 0
    paths = [path for path in cell.paths if path != "main.mod"]
    for _ in range(count):
        path = rng.choice(paths)
        text = cell.text(path)
        change = edit(rng, text)
        back = TextChange(
            change.start, change.start + len(change.text), text[change.start : change.end]
        )
        for one in (change, back):
            start = cpu_ms()
            changed = cell.change(path, [one])
            for other in changed.paths:
                cell.findings(other)
            times.append(cpu_ms() - start)
            local += changed.is_local
    times.sort()
    middle, late = times[len(times) // 2], times[int(len(times) * 0.95)]
    print(
        f"  {title:24} median {middle:6.1f}  95 % {late:6.1f}  most {times[-1]:6.1f} ms;"
        f" {local} of {len(times)} by part"
    )


def half_typed(rng: random.Random, text: str) -> TextChange:
    """A closing word less."""
    return removed(rng, text, "ENDIF\n", text.index("PROC"))


def half_declared(rng: random.Random, text: str) -> TextChange:
    """A semicolon less behind a declaration."""
    return removed(rng, text[: text.index("PROC")], ";", 0)


def removed(rng: random.Random, text: str, part: str, first: int) -> TextChange:
    """Remove a part of a text behind a random place."""
    at = text.index(part, rng.randrange(first, text.rindex(part)))
    return TextChange(at, at + len(part), "")


def type_anew() -> None:
    """Type the modules of a cell from the line behind their head to their end.

    An editor closes a routine when its head is complete, so its body is typed into a closed one.
    """
    texts = {
        file.name: decode(file.read_bytes())[0]
        for file in sorted(CELL.iterdir())
        if file.suffix == ".mod"
    }
    times: list[float] = []
    local = 0
    for path, text in texts.items():
        head, end = text.index("\n") + 1, text.rindex("ENDMODULE")
        cell = opened({**texts, path: f"{text[:head]}\n{text[end:]}"})
        at = head
        for line in text[head:end].splitlines(keepends=True):
            if CLOSER.match(line):
                at += len(line)
                continue
            opener = OPENER.match(line)
            for number, character in enumerate(line, 1):
                is_head = opener is not None and number == len(line)
                typed = f"{character}  END{opener[1]}\n" if opener and is_head else character
                before = cpu_ms()
                changed = cell.change(path, [TextChange(at, at, typed)])
                cell.findings(path)
                times.append(cpu_ms() - before)
                local += changed.is_local
                at += 1
    times.sort()
    print(
        f"typing the modules of {CELL.name}: 95 % {times[int(len(times) * 0.95)]:.1f} ms;"
        f" {local} of {len(times)} characters by part"
    )


def main() -> None:
    """Print the times of all tasks."""
    for modules, lines in ((1, 1000), (1, 10_000), (20, 1000)):
        start = cpu_ms()
        cell = opened(task(modules, lines))
        count = sum(len(cell.findings(path)) for path in cell.paths)
        print(f"{modules} x {lines} lines: {cpu_ms() - start:.0f} ms to the first {count} findings")
        with gc_rarely():
            measure(cell, "within a routine", in_routine, EDITS)
            measure(cell, "a value of a declaration", in_value, EDITS // 10)
            measure(cell, "a declaration", of_declarations, EDITS // 10)
            measure(cell, "a header of a routine", of_headers, EDITS // 10)
            measure(cell, "a block half typed", half_typed, EDITS // 10)
            measure(cell, "a declaration half typed", half_declared, EDITS // 10)
    type_anew()
    start = cpu_ms()
    cell = opened(task(1, 20_000))
    count = sum(len(cell.findings(path)) for path in cell.paths)
    print(f"1 x 20000 lines: {cpu_ms() - start:.0f} ms to the first {count} findings")
    scale = 1024.0 if sys.platform != "darwin" else 1024.0**2
    print(f"memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / scale:.0f} MB")


if __name__ == "__main__":
    main()
