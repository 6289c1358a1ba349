"""No call of the library takes long, whatever its arguments are.

A sample of `benchmarks/fuzz.py times`: what takes arrays and counts, and one routine in many.
"""

import pytest
from fuzzing.times import SIMULATED, calls_of, operator_calls, slow_calls
from laws import some

from rapidsim.library.catalogue import ROUTINES

COUNTING = (
    "dim",
    "rmqsendmessage",
    "uimessagebox",
    "valtostr",
    "strpart",
    "bitlsh",
    "packrawbytes",
)


@pytest.mark.parametrize("name", [*COUNTING, *some(SIMULATED, 60)])
def test_no_argument_makes_a_call_long(name: str) -> None:
    calls = list(calls_of(ROUTINES[name]))
    _, slow = slow_calls(some(calls, 3))
    assert not slow


def test_no_operands_make_an_operator_long() -> None:
    count, slow = slow_calls(some(list(operator_calls()), 150))
    assert count > 5
    assert not slow
