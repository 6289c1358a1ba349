"""A campaign: many programs, the failures kept as small as they get, the counts printed."""

from __future__ import annotations

import re
import time
from collections.abc import Sequence
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
_TOLD = 60
"""Lines of a traceback that are kept from either end."""


def fuzz_programs(seed: int, numbers: Sequence[int]) -> bool:
    """Try programs and print; whether none failed."""
    tally = Tally()
    begin = time.process_time()
    for count, number in enumerate(numbers, 1):
        known = set(tally.failures)
        try_program(seed, number, tally)
        for signature in set(tally.failures) - known:
            (_, failure), *_ = tally.failures[signature]
            print(f"{number}: {signature} ({_kept(seed, number, failure)})", flush=True)
        if count % _PROGRESS == 0:
            print(f"{count} programs, {len(tally.failures)} causes of failure", flush=True)
    _print(tally, seed, numbers, time.process_time() - begin)
    return not tally.failures


def _kept(seed: int, number: int, failure: Failure) -> Path:
    """The folder with the smallest program that fails so."""
    made = program(seed, number)
    attempts = ATTEMPTS_AT_HANGS if failure.hangs else ATTEMPTS
    made = shrunk(made, lambda one: _fails_so(one, failure), attempts)
    folder = FAILURES / re.sub(r"\W+", "_", failure.signature)
    folder.mkdir(parents=True, exist_ok=True)
    for file, text in made.files.items():
        (folder / file).write_text(text, encoding="utf-8")
    lines = failure.text.splitlines()
    lines[_TOLD:-_TOLD] = ["..."] if len(lines) > 2 * _TOLD else lines[_TOLD:-_TOLD]
    told = "\n".join([f"seed {seed}, program {number}", " ".join(failure.arguments), "", *lines])
    (folder / "failure.txt").write_text(told, encoding="utf-8")
    return folder


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


def _print(tally: Tally, seed: int, numbers: Sequence[int], seconds: float) -> None:
    count = max(tally.programs, 1)
    print(
        f"seed {seed}, programs {numbers[0]} to {numbers[-1]}: {tally.programs} programs,"
        f" {100 * tally.accepted / count:.0f} % accepted, {100 * tally.clean / count:.0f} % ran"
        f" clean, {tally.laws} laws compared; {count / seconds:.1f} programs per second of the"
        f" processor"
    )
    for (command, code), times in sorted(tally.codes.items()):
        print(f"{command} ended {times} times with {code}")
    never = sorted(set(SIMULATED) - set(tally.called))
    print(f"{len(SIMULATED) - len(never)} of {len(SIMULATED)} routines called; never:", *never)
    for signature, found in sorted(tally.failures.items(), key=lambda item: -len(item[1])):
        print(f"{len(found)} times, first in {found[0][0]}: {signature}")
