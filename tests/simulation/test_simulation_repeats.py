"""A run is a function of program, robot and inputs: what the process did before does not count."""

from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import rapidsim
from rapidsim.motion import numba_jit

CIRCLE = Path(__file__).parents[2] / "programs" / "circle.mod"


@pytest.mark.skipif(find_spec("numba") is None, reason="numba is not installed")
def test_code_that_was_compiled_for_another_run_changes_no_digit(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    first = rapidsim.simulate([CIRCLE], robot="irb1600").only.trajectory
    monkeypatch.setattr(numba_jit, "_loaded", True)
    again = rapidsim.simulate([CIRCLE], robot="irb1600").only.trajectory
    times = np.linspace(0.0, first.duration, 200)
    assert again.duration == first.duration
    assert np.array_equal(again.at(times).joints, first.at(times).joints)
