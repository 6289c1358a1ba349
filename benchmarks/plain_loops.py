"""The loops of `loops.mod` as a hurried programmer writes them in Python, routine for routine.

No index checks, no single precision, no ticks, indices from 0, integers where they do.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

WORTH = (1000, 900, 500, 400, 100, 90, 50, 40, 10, 9, 5, 4, 1)
DIGITS = ("M", "CM", "D", "CD", "C", "XC", "L", "XL", "X", "IX", "V", "IV", "I")


def fill_list(size: int, seed: int) -> list[int]:
    """Numbers that look random."""
    values = []
    value = seed
    for _ in range(size):
        value = (value * 137 + 187) % 1021
        values.append(value)
    return values


SHUFFLED = fill_list(200, 7)
LEFT = [[1 / (i + j + 1) for j in range(12)] for i in range(12)]
RIGHT = [[(i + 1) - (j + 1) / 10 for j in range(12)] for i in range(12)]
PRODUCT = [[0.0] * 12 for _ in range(12)]
COMPOSITE = [False] * 501


def count_primes() -> int:
    """The sieve of Eratosthenes."""
    found = 0
    for i in range(501):
        COMPOSITE[i] = i == 1
    for i in range(2, 501):
        if not COMPOSITE[i]:
            found += 1
            multiple = i * i
            while multiple <= 500:
                COMPOSITE[multiple] = True
                multiple += i
    return found


def sieve() -> None:
    """Count primes."""
    for _ in range(10):
        count_primes()


def insertion_sort() -> None:
    """Move each value down to its place."""
    values = SHUFFLED[:]
    for i in range(1, len(values)):
        value = values[i]
        hole = i
        moving = True
        while moving:
            if values[hole - 1] > value:
                values[hole] = values[hole - 1]
                hole -= 1
                moving = hole > 0
            else:
                moving = False
        values[hole] = value


def exchange(values: list[int], a: int, b: int) -> None:
    """Exchange two places."""
    values[a], values[b] = values[b], values[a]


def sort_by_parts(values: list[int], first: int, last: int) -> None:
    """Quicksort between two places, both included."""
    if first >= last:
        return
    pivot = values[(first + last) // 2]
    low = first
    high = last
    while low <= high:
        while values[low] < pivot:
            low += 1
        while values[high] > pivot:
            high -= 1
        if low <= high:
            exchange(values, low, high)
            low += 1
            high -= 1
    sort_by_parts(values, first, high)
    sort_by_parts(values, low, last)


def quicksort() -> None:
    """Sort by parts."""
    for _ in range(5):
        sort_by_parts(SHUFFLED[:], 0, 199)


def multiply(a: list[list[float]], b: list[list[float]], product: list[list[float]]) -> None:
    """The product of two matrices."""
    for row in range(len(a)):
        for column in range(len(b[0])):
            total = 0.0
            for k in range(len(b)):
                total = total + a[row][k] * b[k][column]
            product[row][column] = total


def matrix_product() -> None:
    """Multiply matrices."""
    for _ in range(3):
        multiply(LEFT, RIGHT, PRODUCT)


def roman(value: int) -> str:
    """Roman digits."""
    text = ""
    rest = value
    for i in range(13):
        while rest >= WORTH[i]:
            text = text + DIGITS[i]
            rest -= WORTH[i]
    return text


def backwards(text: str) -> str:
    """The letters from the last to the first."""
    result = ""
    for i in range(len(text) - 1, -1, -1):
        result = result + text[i]
    return result


def packed(text: str) -> str:
    """Runs of equal letters as letter and count."""
    result = ""
    run = 0
    for i in range(len(text)):
        letter = text[i]
        run += 1
        if i == len(text) - 1:
            result = result + letter + str(run)
        elif text[i + 1] != letter:
            result = result + letter + str(run)
            run = 0
    return result


def texts() -> None:
    """Build strings."""
    for year in range(1950, 2051):
        roman(year)
    for _ in range(50):
        packed(backwards("aaabccdddddeffggggh"))


@dataclass
class Order:
    """What waits in the queue."""

    part: str
    pieces: float
    urgent: bool


class Ring:
    """A queue of at most four orders."""

    def __init__(self) -> None:
        """Begin empty."""
        self.orders: list[Order | None] = [None] * 4
        self.first = 0
        self.length = 0

    def append(self, order: Order) -> None:
        """Put an order at the end."""
        if self.length == 4:
            raise OverflowError
        self.orders[(self.first + self.length) % 4] = order
        self.length += 1

    def take(self) -> Order:
        """Take the first order."""
        if self.length == 0:
            raise LookupError
        order = self.orders[self.first]
        assert order is not None
        self.first = (self.first + 1) % 4
        self.length -= 1
        return order


RING = Ring()


def records() -> None:
    """Put orders into a queue and take them out."""
    pieces = 0.0
    for turn in range(1, 301):
        RING.append(Order("gear", 5, False))
        RING.append(Order("cover", 2, True))
        order = RING.take()
        order.pieces = order.pieces + turn
        pieces = pieces + order.pieces
        order = RING.take()


def fibonacci(n: int) -> int:
    """The recursive definition."""
    if n < 2:
        return n
    return fibonacci(n - 1) + fibonacci(n - 2)


def recursion() -> None:
    """Call much."""
    fibonacci(16)


def steps_to_one(start: int) -> int:
    """Halve what is even, else three times and one more."""
    value = start
    turns = 0
    while value != 1:
        value = value // 2 if value % 2 == 0 else 3 * value + 1
        turns += 1
    return turns


def collatz() -> None:
    """Count steps for many starts."""
    longest = 0
    for start in range(1, 101):
        turns = steps_to_one(start)
        if turns > longest:
            longest = turns


def root_of(x: float) -> float:
    """Newton's method."""
    guess = x
    while abs(guess * guess - x) > 1e-6:
        guess = (guess + x / guess) / 2
    return guess


def quarter_circle(strips: int) -> float:
    """The area below a quarter of the unit circle."""
    area = 0.0
    for i in range(1, strips + 1):
        x = (i - 0.5) / strips
        area = area + sqrt(1 - x * x) / strips
    return area


def harmonic(terms: int) -> float:
    """The sum of reciprocals."""
    total = 0.0
    for i in range(1, terms + 1):
        total = total + 1 / i
    return total


def floats() -> None:
    """Compute with fractions."""
    total = 0.0
    for _ in range(10):
        total = total + quarter_circle(200) + harmonic(300) + root_of(2)
