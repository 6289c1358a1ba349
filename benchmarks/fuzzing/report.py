"""A campaign: many programs, the failures kept as small as they get, the counts printed."""

from __future__ import annotations

import re
import signal
import time
from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from itertools import count
from multiprocessing import active_children, get_context
from pathlib import Path

from fuzzing.campaign import (
    FOLDER,
    LAW,
    SIMULATED,
    Tally,
    difference,
    program,
    try_program,
    written,
)
from fuzzing.laws import LAWS
from fuzzing.programs import Made
from fuzzing.sending import Failure, send
from fuzzing.shrinking import shrunk

FAILURES = Path("fuzz-failures")
ATTEMPTS = 400
ATTEMPTS_AT_HANGS = 40
_PROGRESS = 100
_CHUNK = 20
"""Programs that a process tries before it ends."""
_TOLD = 60
"""Lines of a traceback that are kept from either end."""


def fuzz_programs(seed: int, numbers: Sequence[int]) -> bool:
    """Try programs and print; whether none failed."""
    begin = time.process_time()
    tally = Tally()
    for first in range(0, len(numbers), _PROGRESS):
        tally.add(_tried(seed, numbers[first : first + _PROGRESS]))
        print(f"{tally.programs} programs, {len(tally.failures)} causes of failure", flush=True)
    _print(tally, seed, numbers[0], time.process_time() - begin)
    return not tally.failures


def fuzz_nightly(seed: int, begin: int, processes: int) -> bool:
    """Try programs until Ctrl-C or SIGTERM; print, and whether none failed."""
    tally, started_s = Tally(), time.monotonic()
    chunks = (range(first, first + _CHUNK) for first in count(begin, _CHUNK))
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    # Each chunk has a fresh process, whose memory ends with it.
    pool = ProcessPoolExecutor(
        processes, get_context("spawn"), initializer=_ignore_interrupts, max_tasks_per_child=1
    )
    work = [pool.submit(_tried, seed, next(chunks)) for _ in range(processes)]
    try:
        while True:
            done, rest = wait(work, return_when=FIRST_COMPLETED)
            for future in done:
                tally.add(future.result())
            work = [*rest, *(pool.submit(_tried, seed, next(chunks)) for _ in done)]
            print(
                f"{tally.programs} programs, about {tally.statements} statements, {tally.laws}"
                f" laws compared, {len(tally.failures)} causes of failure",
                flush=True,
            )
    except KeyboardInterrupt:
        # What they have not reported is lost: less than a chunk each.
        for process in active_children():
            process.terminate()
        pool.shutdown(cancel_futures=True)
    _print(tally, seed, begin, (time.monotonic() - started_s) * processes)
    return not tally.failures


def _ignore_interrupts() -> None:
    """Ctrl-C reaches all processes; the first one ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _tried(seed: int, numbers: Sequence[int]) -> Tally:
    """Try programs, and keep the smallest that fails so of each new cause."""
    tally = Tally()
    for number in numbers:
        known = set(tally.failures)
        try_program(seed, number, tally)
        for signature in set(tally.failures) - known:
            (_, failure), *_ = tally.failures[signature]
            if not _folder_of(failure).exists():
                print(f"{number}: {signature} ({_kept(seed, number, failure)})", flush=True)
    return tally


def _kept(seed: int, number: int, failure: Failure) -> Path:
    """The folder with the smallest program that fails so."""
    made = program(seed, number)
    attempts = ATTEMPTS_AT_HANGS if failure.hangs else ATTEMPTS
    made = shrunk(made, lambda one: _fails_so(one, failure), attempts)
    folder = _folder_of(failure)
    folder.mkdir(parents=True, exist_ok=True)
    for file, text in made.files.items():
        (folder / file).write_text(text, encoding="utf-8")
    lines = failure.text.splitlines()
    lines[_TOLD:-_TOLD] = ["..."] if len(lines) > 2 * _TOLD else lines[_TOLD:-_TOLD]
    told = "\n".join([f"seed {seed}, program {number}", " ".join(failure.arguments), "", *lines])
    (folder / "failure.txt").write_text(told, encoding="utf-8")
    return folder


def _folder_of(failure: Failure) -> Path:
    return FAILURES / re.sub(r"\W+", "_", failure.signature)


def _fails_so(made: Made, failure: Failure) -> bool:
    if failure.arguments[0] == LAW:
        law = next(one for one in LAWS if one.name == failure.arguments[1])
        return difference(made, law, Tally()) is not None
    with written(made) as folder:
        (folder / "home").mkdir()
        arguments = [
            a.replace(FOLDER, str(folder))
            for a in failure.arguments
            if not a.startswith(f"{FOLDER}/") or not a.endswith(".mod") or a[7:] in made.files
        ]
        _, found = send(*arguments)
    if found is None:
        return False
    return found.hangs if failure.hangs else found.signature == failure.signature


def _print(tally: Tally, seed: int, begin: int, seconds: float) -> None:
    programs = max(tally.programs, 1)
    print(
        f"seed {seed}, {tally.programs} programs from {begin} on, about {tally.statements}"
        f" statements: {100 * tally.accepted / programs:.0f} % accepted,"
        f" {100 * tally.clean / programs:.0f} % ran clean, {tally.laws} laws compared, on"
        f" {100 * tally.lawful / programs:.0f} %; {programs / seconds:.1f} programs per second"
    )
    for (command, code), times in sorted(tally.codes.items()):
        print(f"{command} ended {times} times with {code}")
    never = sorted(set(SIMULATED) - set(tally.called))
    print(f"{len(SIMULATED) - len(never)} of {len(SIMULATED)} routines called; never:", *never)
    for signature, found in sorted(tally.failures.items(), key=lambda item: -len(item[1])):
        print(f"{len(found)} times, first in {found[0][0]}: {signature}")
