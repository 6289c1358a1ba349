"""The program of algorithms prints what Python computes for itself with RAPID's numbers."""

from __future__ import annotations

import json
import struct
from collections import deque
from collections.abc import Callable, Iterator
from math import gcd, sqrt
from pathlib import Path

from command_line import call

PROGRAM = Path(__file__).parents[2] / "programs" / "algorithms.mod"
Vector = list[float]


def single(x: float) -> float:
    """The nearest 32-bit number."""
    value: float = struct.unpack("<f", struct.pack("<f", x))[0]
    return value


def shown(x: float) -> str:
    return f"{x:.6G}"


def screen(folder: Path) -> list[str]:
    run = call("run", PROGRAM, "--no-record", "--format", "json", cwd=folder)
    assert run.code == 0, run.err
    report = json.loads(run.out)
    assert report["end"] == "ended"
    return [event["message"] for event in report["events"] if event["kind"] == "text"]


def test_the_screen_shows_what_python_computes(tmp_path: Path) -> None:
    expected = [
        *sorting(),
        *primes(),
        *matrices(),
        *texts(),
        *orders(),
        *recursion(),
        *numbers(),
    ]
    assert screen(tmp_path) == expected


def sorting() -> Iterator[str]:
    values = []
    value = 7
    for _ in range(40):
        value = (value * 137 + 187) % 1021
        values.append(value)
    in_order = sorted(values)
    yield f"unsorted {checksum(values)}"
    yield f"sorted {checksum(in_order)}"
    yield "both agree TRUE"
    yield f"smallest, median, largest {in_order[0]} {in_order[19]} {in_order[-1]}"
    yield f"found at {in_order.index(values[4]) + 1}"
    yield "not found 0"


def checksum(values: list[int]) -> int:
    total = 0
    for value in values:
        total = (total * 31 + value) % 8191
    return total


def primes() -> Iterator[str]:
    found = {n for n in range(2, 501) if all(n % d for d in range(2, n))}
    yield f"primes {len(found)}"
    yield f"twins {sum(n + 2 in found for n in found)}"


def matrices() -> Iterator[str]:
    # Operands are singles, an expression is computed in doubles and rounded at its end.
    a = [[single(1 / (i + j + 1)) for j in range(6)] for i in range(6)]
    b = [[single((i + 1) - (j + 1) / 10) for j in range(6)] for i in range(6)]
    c = [[folded(lambda s, k: s + a[i][k] * b[k][j]) for j in range(6)] for i in range(6)]  # noqa: B023 - called at once
    yield f"first row {shown(c[0][0])} {shown(c[0][1])} {shown(c[0][5])}"
    yield f"trace {shown(folded(lambda s, i: s + c[i][i]))}"
    squares = folded(lambda s, i: s + c[i][5] * c[i][5])
    yield f"length of the last column {shown(single(sqrt(squares)))}"


def folded(step: Callable[[float, int], float]) -> float:
    """A sum over six terms that is stored as a single after each."""
    total = 0.0
    for k in range(6):
        total = single(step(total, k))
    return total


def texts() -> Iterator[str]:
    yield "roman MCMXCIV MMXXIV XLIX"
    yield f"backwards {'simulated robot'[::-1]}"
    yield "packed a3b1c2d5e1"
    yield f"palindrome {str('reliefpfeiler'[::-1] == 'reliefpfeiler').upper()}"


def orders() -> Iterator[str]:
    arriving = [("flange", 12, 0), ("bracket", 3, 1), ("shaft", 7, 0), ("cover", 20, 1)]
    queue = deque(arriving, maxlen=4)
    yield f"dropped {queue[0][0]}"
    queue.append(("gear", 5, 0))
    for part, pieces, _ in queue:
        yield f"{'small' if pieces in (3, 5, 7) else 'large'}: {part}"
    yield f"shipped {sum(pieces + urgent for _, pieces, urgent in queue)}"
    # The failing assignment is skipped, so the variable keeps the last order.
    yield "nothing to do"
    yield f"after the empty queue: {queue[-1][0]}"


def recursion() -> Iterator[str]:
    factorial, a, b = 1.0, 0, 1
    for n in range(1, 11):
        factorial *= n
    for _ in range(12):
        a, b = b, a + b
    yield f"10! {shown(factorial)}"
    yield f"fibonacci {a}"
    yield f"common divisor {gcd(1071, 462)}"
    yield "the largest goes from left to right"
    yield f"discs moved {2**6 - 1}"
    turns, value = 0, 27
    while value != 1:
        value = 3 * value + 1 if value % 2 else value // 2
        turns += 1
    yield f"steps to one {turns}"


def numbers() -> Iterator[str]:
    tenth = single(0.1)
    total = 0.0
    for _ in range(1000):
        total = single(total + tenth)
    yield f"a thousand tenths {shown(total)}"
    assert total != 100
    yield "is it 100? FALSE"
    yield "one more than 2^24 is lost TRUE"

    guess = 2.0
    while single(abs(single(guess * guess - 2))) > single(0.000001):
        guess = single((guess + 2 / guess) / 2)
    yield f"root {shown(guess)}"

    area = 0.0
    for i in range(1, 201):
        x = single((i - 0.5) / 200)
        area = single(area + single(sqrt(single(1 - x * x))) / 200)
    yield f"quarter circle {shown(area)}"

    harmonic = 0.0
    for i in range(1, 301):
        harmonic = single(harmonic + 1 / i)
    yield f"harmonic {shown(harmonic)}"

    x = single(1e38)
    while x * 2 <= 3.4028235e38:
        x = single(x * 2)
    yield f"overflow after {shown(x)}"
