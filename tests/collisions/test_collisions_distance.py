"""Distances between convex parts: closed forms, and another library as the oracle."""

from __future__ import annotations

from itertools import combinations_with_replacement

import numpy as np
import pytest
from collision_truths import KINDS, arm_touches, pairs_apart
from laws import cases

from rapidsim import load_robot
from rapidsim.collisions import shape
from rapidsim.collisions.convex import ConvexParts
from rapidsim.collisions.distance import distances
from rapidsim.collisions.overlap import shortest
from rapidsim.frames.transform import Transform


@pytest.mark.parametrize("kinds", [*combinations_with_replacement(KINDS, 2)], ids="-".join)
def test_bodies_are_as_far_apart_as_their_formulas_say(kinds: tuple[str, str]) -> None:
    found, exact = pairs_apart(np.random.default_rng(1), *kinds, cases(1000))
    over = np.isneginf(exact)
    np.testing.assert_allclose(found[~over], exact[~over], atol=1e-9)
    assert (found[over] < 1e-6).all()


def test_a_cylinder_stands_on_a_box_and_a_sphere_beside_it() -> None:
    parts = ConvexParts(
        [
            shape.cylinder(0.1, 0.4).parts[0],
            shape.box(np.array([1.0, 1.0, 0.2])).parts[0],
            shape.sphere(0.05).parts[0],
        ]
    )
    beside = Transform(np.eye(3)[None], np.array([[0.3, 0.0, 0.1]]))
    above = Transform(np.eye(3)[None], np.array([[0.0, 0.0, 0.35]]))
    one, two, three = (np.array([k]) for k in range(3))
    assert distances(parts, one, two, above).distances_found[0] == pytest.approx(0.05, abs=1e-9)
    assert distances(parts, three, one, beside).distances_found[0] == pytest.approx(0.15, abs=1e-9)
    deeper = Transform(np.eye(3)[None], np.array([[0.0, 0.0, 0.28]]))
    assert shortest(parts, one, two, deeper)[0] == pytest.approx(0.02, abs=1e-9)


def test_what_is_all_but_above_the_middle_of_a_sheet_is_measured_to_the_end() -> None:
    """The shortest way is known to the last digit before the bound on it is."""
    parts = ConvexParts(
        [shape.sphere(0.002).parts[0], shape.box(np.array([0.06, 0.06, 5e-4])).parts[0]]
    )
    above = Transform(np.eye(3)[None], np.array([[-3.7e-7, 3.8e-7, -9.715702e-4]]))
    found = distances(parts, np.array([0]), np.array([1]), above)
    assert found.distances_found[0] == pytest.approx(9.715702e-4 - 2.5e-4 - 0.002, abs=1e-12)
    assert found.least[0] == pytest.approx(found.distances_found[0], abs=1e-9)


@pytest.mark.parametrize("name", ["irb1600-6-1.2", "irb140-6-0.81", "kr16-2"])
def test_links_and_a_box_touch_where_another_library_says_so(name: str) -> None:
    tally = arm_touches(load_robot(name), cases(300), seed=3)
    assert not tally.wrong
    assert tally.touching
