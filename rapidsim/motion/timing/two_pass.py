"""Time-optimal motion along a path that keeps every limit, in closed form.

Along the path parameter s, x is the square of the path speed ds/dt and u the path acceleration,
constant within a stage. Every acceleration row requires |slope u + bend x| <= 1 at both ends of a
stage. A backward pass finds the largest x from which the arm can still brake, a forward pass is as
fast as that allows. Because limits are symmetric, x = 0 is always feasible, so every stage has a
solution.

A motion that starts too fast brakes as hard as its rows allow until its speed is feasible. If that
is too late for the next stop, all rows are relaxed by the smallest factor k that suffices: where
every |slope u + bend x| may be k times as large, so may x and u, and the largest x of the start.

Source: the two-pass method of Pham and Pham (2018), A new approach to time-optimal path
parameterization based on reachability analysis, with its linear programs solved by hand.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.numba_jit import jit_function
from rapidsim.motion.timing import two_pass_loops
from rapidsim.motion.timing.smallest_line import sweep
from rapidsim.motion.timing.stages import Stages

_STEEP = 1e-12
_SLOWEST = 1e-18
"""Square of a path speed [m2/s2] that counts as rest."""
_ROUNDING = 1e-9


def solve(stages: Stages, caps: Array, start_speed: float) -> tuple[Array, float, int]:
    """Return the fastest x at the nodes.

    Args:
        stages: Limits of u.
        caps: Largest x at the nodes, shape (m + 1,).
        start_speed: Path speed [m/s] at the first node.

    Returns:
        x (m + 1,), the largest x at the first node from which the rest is feasible, and the number
        of stages in which a faster start is braked.
    """
    first, stands = start_speed**2, np.append(caps[:-1], 0.0) == 0.0
    caps = np.append(np.minimum(caps[:-1], stages.widest), 0.0)
    x, fastest = _both_passes(stages, caps, first)
    braked = 0
    if first > fastest:
        # The limits of speeds alone do not count; they are exceeded as shortly as possible.
        hard = np.where(stands, 0.0, np.append(stages.widest, 0.0))
        relaxed = max(1.0, first / max(_both_passes(stages, hard, 0.0)[1], _SLOWEST))
        braked = _brake(stages, x, relaxed)
    return x, fastest, braked


def _both_passes(stages: Stages, caps: Array, first: float) -> tuple[Array, float]:
    """Return x (m + 1,) from `first` on, under caps (m + 1,), and the largest x of the start."""
    slack, tilt = stages.slack, stages.tilt
    span = 2.0 * stages.width
    kernel = jit_function(two_pass_loops, "both_passes", len(span))
    if kernel is not None:
        x = np.empty(len(caps))
        fastest = kernel(first, slack, tilt, span, _STEEP, caps, x)
        return x, float(fastest)

    # Backwards: the largest x from which u >= -slack - tilt x leads to the node after.
    keeps = 1.0 - span[:, None] * tilt
    reaches = keeps > _STEEP
    safe = np.where(reaches, keeps, 1.0)
    slopes = np.where(reaches, 1.0 / safe, 0.0)
    offsets = np.where(reaches, span[:, None] * slack / safe, np.inf)
    largest = sweep(0.0, slopes[::-1], offsets[::-1], caps[::-1])[::-1]

    # Forwards: the largest u <= slack - tilt x that stays below.
    x = sweep(first, keeps, span[:, None] * slack, largest)
    return x, float(largest[0])


def _brake(stages: Stages, x: Array, relaxed: float) -> int:
    """Replace x (m + 1,) after a start that is too fast, with rows relaxed by a factor.

    Returns:
        The number of stages until x is as before.
    """
    nearly = _ROUNDING * x[0]
    rows = zip(relaxed * stages.slack, stages.tilt, 2.0 * stages.width, strict=True)
    for k, (slack, tilt, span) in enumerate(rows):
        lowest = x[k] - span * float(np.min(slack + tilt * x[k]))
        if lowest <= x[k + 1] + nearly:
            return k + 1
        x[k + 1] = lowest
    return len(x) - 1
