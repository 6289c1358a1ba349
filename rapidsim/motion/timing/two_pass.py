"""Time-optimal motion along a path that keeps every limit, in closed form.

Along the path parameter s, x is the square of the path speed ds/dt and u the path acceleration,
constant within a stage. Every acceleration row requires |slope u + bend x| <= 1 at both ends of a
stage. A backward pass finds the largest x from which the arm can still brake, a forward pass is as
fast as that allows. Because limits are symmetric, x = 0 is always feasible, so every stage has a
solution.

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


def solve(stages: Stages, caps: Array, start_speed: float) -> tuple[Array, float]:
    """Return the fastest x at the nodes.

    Args:
        stages: Limits of u.
        caps: Largest x at the nodes, shape (m + 1,).
        start_speed: Path speed [m/s] at the first node.

    Returns:
        x (m + 1,), and the largest x at the first node from which the rest is feasible.
    """
    caps = np.append(np.minimum(caps[:-1], stages.widest), 0.0)
    slack, tilt = stages.slack, stages.tilt
    span = 2.0 * stages.width
    kernel = jit_function(two_pass_loops, "both_passes", len(span))
    if kernel is not None:
        x = np.empty(len(caps))
        first = kernel(start_speed**2, slack, tilt, span, _STEEP, caps, x)
        return x, float(first)

    # Backwards: the largest x from which u >= -slack - tilt x leads to the node after.
    keeps = 1.0 - span[:, None] * tilt
    reaches = keeps > _STEEP
    safe = np.where(reaches, keeps, 1.0)
    slopes = np.where(reaches, 1.0 / safe, 0.0)
    offsets = np.where(reaches, span[:, None] * slack / safe, np.inf)
    largest = sweep(0.0, slopes[::-1], offsets[::-1], caps[::-1])[::-1]

    # Forwards: the largest u <= slack - tilt x that stays below.
    x = sweep(start_speed**2, keeps, span[:, None] * slack, largest)
    return x, float(largest[0])
