"""How near a run comes to what a real controller did: the figures that the documentation gives."""

from __future__ import annotations

import importlib.util
import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]
TRACES = ROOT.parent / "shared" / "reference" / "abb_traces_dev.json"


def _benchmark() -> ModuleType:
    """The benchmark as a module; `benchmarks` is no package."""
    spec = importlib.util.spec_from_file_location("fidelity", ROOT / "benchmarks" / "fidelity.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.mark.skipif(not TRACES.exists(), reason=f"{TRACES} is not here")
@pytest.mark.parametrize(
    ("model", "end_percent", "time_ms", "corners_percent"),
    # Without its torques the arm is taken to be as quick stretched out as drawn in.
    [("default", 2.5, 45.0, 14.0), ("measured", 0.5, 12.5, 9.0)],
)
def test_a_run_takes_the_time_that_the_controller_took(
    model: str, end_percent: float, time_ms: float, corners_percent: float
) -> None:
    fidelity = _benchmark()
    traces = fidelity.read_traces(TRACES)
    found = fidelity.fidelities(traces, getattr(fidelity, f"{model}_model")())
    assert len(found) == 5
    for trace in found:
        assert abs(trace.end_percent) < end_percent, trace
        assert trace.time_rms_ms < time_ms, trace
        assert not trace.corner_speed_percent > corners_percent, trace
        assert trace.off_path_deg < 0.1, trace


@pytest.mark.skipif(not TRACES.exists(), reason=f"{TRACES} is not here")
def test_with_each_axis_smoothed_a_run_rounds_corners_as_the_controller_did() -> None:
    fidelity = _benchmark()
    traces = fidelity.read_traces(TRACES)
    found = fidelity.fidelities(traces, replace(fidelity.measured_model(), smoothing="axes"))
    assert [trace.corner_cut_mm < 0.8 for trace in found] == [False, True, True, False, True]
    for trace in found:
        assert abs(trace.end_percent) < 0.6, trace
        assert trace.time_rms_ms < 12.5, trace
        assert trace.off_path_deg < 0.03, trace
        if "movel_v5000" in trace.name:
            assert trace.corner_cut_mm < 0.35, trace
