"""What a served controller does is in a recording that grows with it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from served_controller import STEP_S
from test_server_programs import COUNTING

from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.recording.live_recording import LiveRecording
from rapidsim.server.engine import Engine
from rapidsim.server.loading import engine_of, ready
from rapidsim.server.messages import Request
from rapidsim.server.recorder import LiveRecorder
from rapidsim.server.settings import EngineSettings

MOVING = COUNTING.replace(
    "WaitTime 0.2;",
    "MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;\n"
    '        TPWrite "a round";',
)


def recorded(folder: Path, file: Path) -> tuple[Engine, list[str]]:
    """A controller that is recorded, and what is said where that fails."""
    (folder / "main.mod").write_text(MOVING)
    made = ready(RunRequest(paths=(str(folder / "main.mod"),), home=str(folder)))
    engine, failures = engine_of(made, EngineSettings(request_s=STEP_S), print), list[str]()
    recorder = LiveRecorder(engine.live, LiveRecording(file, False), failures.append)
    recorder.begin()
    engine.record(recorder)
    return engine, failures


def rows(file: Path) -> dict[str, list[Any]]:
    """The values of each column of a recording, by its entity and its name."""
    from rerun.chunk import RrdReader  # noqa: PLC0415

    found: dict[str, list[Any]] = {}
    for chunk in RrdReader(str(file)).stream():
        batch = chunk.to_record_batch()
        for name, column in zip(batch.schema.names, batch.columns, strict=True):
            if ":" in name:
                values = [one[0] if len(one) == 1 else one for one in column.to_pylist() if one]
                found.setdefault(f"{chunk.entity_path} {name}", []).extend(values)
    return found


def test_axes_states_texts_and_requests_are_in_it_and_it_appears_at_the_end(tmp_path: Path) -> None:
    file = tmp_path / "day.rrd"
    with recursion_limit(RUNNING_DEPTH):
        engine, failures = recorded(tmp_path, file)
        execution = "/rw/rapid/execution"
        engine.reply(Request("POST", execution, {"action": "start"}, {"cycle": "once"}))
        for _ in range(30):
            engine.reply(Request("GET", execution))
        assert engine.recorder is not None
        engine.recorder.on_sensor_answer(
            engine.live.now_s, SensorAnswer(correction=(0.0, 1.0, 2.0))
        )
        engine.reply(Request("POST", execution, {"action": "none"}))
        assert not file.exists()
        engine.switch_off()
    assert failures == []
    found = rows(file)
    texts = [text for key, some in found.items() if "TextLog:text" in key for text in some]
    assert f"POST {execution}?action=start cycle=once" in texts
    assert "a round" in texts
    assert any(text.startswith("10150 Program started") for text in texts)
    assert any(text.endswith(": 400") for text in texts)
    (degrees,) = [some for key, some in found.items() if key.startswith("/axes/1 Scalars")]
    assert degrees[0] == 0.0
    assert degrees[-1] == pytest.approx(20.0)
    assert (np.diff(degrees) >= -1e-9).all()
    (states,) = [some for key, some in found.items() if "StateChange:state" in key]
    assert states == ["stands", "runs", "stands"]
    (wanted,) = [some for key, some in found.items() if key.startswith("/sensor/correction")]
    assert wanted == [[0.0, 1.0, 2.0]]


def test_a_recording_that_cannot_go_on_ends_and_the_controller_does_not(tmp_path: Path) -> None:
    with recursion_limit(RUNNING_DEPTH):
        engine, failures = recorded(tmp_path, tmp_path / "day.rrd")
        assert isinstance(engine.recorder, LiveRecorder)

        def full() -> None:
            raise OSError("the disk is full")

        engine.recorder._do(full)
        engine.reply(Request("POST", "/rw/rapid/execution", {"action": "start"}))
        assert engine.live.executes
        assert failures == ["error: nothing more is recorded: the disk is full"]
        engine.switch_off()
