"""Draw docs/pictures/fidelity.png: how far runs are from what a controller took, by motion model.

    python scripts/draw_fidelity.py

The corners are those of tests/simulation/test_simulation_logged_corners.py, written anew from their
geometry; the figures of the controller are of its logs. Prints what it draws.
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np

from rapidsim.motion.model import MODELS

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "simulation"))

import test_simulation_logged_corners as logged  # noqa: E402  (found by the line above)

mpl.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)

COLOURS = {"1": "#b0b0b0", "3": "#1f77b4"}
NAMES = {"1": "motion model 1", "3": "motion models 2 and 3"}


def main() -> None:
    """Run all corners with the models and draw both errors."""
    labels = [
        f"{'aside' if corner is logged.ASIDE else 'outwards'} {speed} {zone}"
        for corner, speed, zone, _, _ in logged.CASES
    ]
    figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(9.0, 5.4), layout="tight")
    places = np.arange(len(labels))
    for number, version in enumerate(NAMES):
        found = [logged.figures_of(*case[:3], MODELS[version]) for case in logged.CASES]
        duration = [
            100.0 * (ours / case[3] - 1.0)
            for (ours, _), case in zip(found, logged.CASES, strict=True)
        ]
        speed = [
            np.nan if case[4] is None else 100.0 * (ours / case[4] - 1.0)
            for (_, ours), case in zip(found, logged.CASES, strict=True)
        ]
        at = places + 0.38 * (number - 0.5)
        above.bar(at, duration, 0.36, color=COLOURS[version], label=NAMES[version])
        below.bar(at, speed, 0.36, color=COLOURS[version])
        for label, one, other in zip(labels, duration, speed, strict=True):
            print(f"model {version}  {label:<24} {one:+6.2f} %  {other:+6.1f} %")
    above.set_ylabel("duration, ours less\nthe controller's [%]")
    below.set_ylabel("speed in the corner,\nlikewise [%]")
    below.set_xticks(places, labels, rotation=50, ha="right", fontsize=8)
    above.legend(frameon=False, fontsize=9)
    for axes in (above, below):
        axes.axhline(0.0, color="black", linewidth=0.8)
        axes.grid(axis="y", color="#e5e5e5")
        axes.set_axisbelow(True)
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(ROOT / "docs" / "pictures" / "fidelity.png", dpi=120)


if __name__ == "__main__":
    main()
