"""Zeros of non-decreasing functions: many at once, each within its own bracket.

Newton's method where slopes are known, for as long as it converges quickly. Otherwise bracketed
inverse quadratic interpolation, or bisection where that is not worthwhile.

Source:
    Chandrupatla (1997), A new hybrid quadratic/bisection algorithm for finding the zero of a
    nonlinear function without using derivatives; in the form of Scherer (2017), Computational
    Physics, section 6.1.7.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array

_DIGITS = 4.0 * np.finfo(np.float64).eps
_MOST_STEPS = 100
_NEWTON_STEPS = 6
"""Maximum number of steps; two to five suffice where the method converges quickly."""


def first_crossing_by_slope(
    function: Callable[[Array], tuple[Array, Array]],
    level: Array,
    early: Array,
    late: Array,
    *,
    within: float,
) -> Array:
    """Return the arguments at which one function with a known slope reaches levels.

    Args:
        function: Returns values (m,) and slopes (m,) at arguments (m,).
        level: Levels (k,).
        early: Lower bounds (k,).
        late: Upper bounds (k,).
        within: Absolute tolerance.

    Returns:
        Shape (k,); see `first_crossing`. Where the function stands at just that level, any such
        argument.
    """
    low, high, found = early.copy(), late.copy(), 0.5 * (early + late)
    row, x = np.arange(len(level)), found.copy()
    slow = np.zeros(len(level), dtype=np.bool_)
    for _ in range(_NEWTON_STEPS):
        value, slope = function(x)
        past = value - level[row]
        low[row] = np.where(past < 0.0, x, low[row])
        high[row] = np.where(past < 0.0, high[row], x)
        a, b = low[row], high[row]
        pays = slope * (b - a) > np.abs(past)
        found[row] = np.clip(x - np.divide(past, slope, out=x - 0.5 * (a + b), where=pays), a, b)
        # Just before a standstill, rounding of the value moves its zero farther than a step.
        slow[row] = within * slope <= _DIGITS * np.abs(value)
        going = np.abs(found[row] - x) > np.maximum(0.5 * within, _DIGITS * np.abs(x))
        going &= ~slow[row]
        row = row[going]
        if not len(row):
            break
        x = found[row]
    slow[row] = True
    rest = np.flatnonzero(slow)
    found[rest] = first_crossing(
        lambda now, of: function(now)[0] - level[rest[of]], early[rest], late[rest], within=within
    )
    return found


def first_crossing(
    function: Callable[[Array, npt.NDArray[np.int64]], Array],
    early: Array,
    late: Array,
    *,
    within: float = 0.0,
) -> Array:
    """Return the arguments at which functions cease to be negative.

    Args:
        function: Returns values (m,) at arguments (m,) of the functions with indices (m,).
        early: Lower bounds (k,).
        late: Upper bounds (k,).
        within: Absolute tolerance.

    Returns:
        Shape (k,), within the tolerance or to the last digits; `early` for a function that is not
        negative there, `late` for one that is negative throughout.
    """
    everything = np.arange(len(early))
    at_early, at_late = function(early, everything), function(late, everything)
    found = np.where(at_early >= 0.0, early, late)
    row = np.flatnonzero((at_early < 0.0) & (at_late >= 0.0))
    # a and b enclose the zero, c is the end that a or b replaced.
    a, b, fa, fb = late[row], early[row], at_late[row], at_early[row]
    share = np.full(len(row), 0.5)
    for _ in range(_MOST_STEPS):
        if not len(row):
            break
        x = a + share * (b - a)
        fx = function(x, row)
        same = (fx >= 0.0) == (fa >= 0.0)
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, fx
        found[row] = np.where(fa >= 0.0, a, b)
        least = np.maximum(_DIGITS * np.abs(a), 0.5 * within)
        width = np.abs(b - a)
        going = width > 2.0 * least
        row, least = row[going], least[going] / width[going]
        a, b, c, fa, fb, fc = (one[going] for one in (a, b, c, fa, fb, fc))
        share = np.clip(_share(a, b, c, fa, fb, fc), least, 1.0 - least)
    return found


def _share(a: Array, b: Array, c: Array, fa: Array, fb: Array, fc: Array) -> Array:
    """Return the next argument as a share of the distance from a to b."""
    # Constant functions do not allow interpolation.
    pays = (fa != 0.0) & (fb != 0.0) & (fc != fa) & (fc != fb)
    xi = (a - b) / (c - b)
    phi = (fa - fb) / np.where(pays, fc - fb, 1.0)
    pays &= (phi**2 < xi) & ((1.0 - phi) ** 2 < 1.0 - xi)
    share = np.full(len(a), 0.5)
    a, b, c, fa, fb, fc = (one[pays] for one in (a, b, c, fa, fb, fc))
    share[pays] = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (
        fc - fb
    )
    return share
