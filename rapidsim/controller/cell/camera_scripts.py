"""Cameras of a cell: what each finds in one picture after the other.

Plain data, read from the station file or the file that `--io` names.
"""

from __future__ import annotations

from dataclasses import field

from rapidsim.language.option_data import CameraTarget
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True)
class CameraScript:
    """What a camera finds."""

    name: str
    pictures: tuple[tuple[CameraTarget, ...], ...]
    """What there is to see in each picture."""
    after_s: float = 0.0
    """From asking for a picture to its results."""
    repeats: bool = False
    """The pictures begin again after the last one; else later ones show nothing."""
    parameters: tuple[tuple[str, float | bool | str], ...] = ()
    """What its job can be set to, by folded name, and the values at the start."""


@dataclass(slots=True, eq=False)
class CameraState:
    """A camera while a run lasts; implements `language.cameras.Camera`."""

    script: CameraScript
    name: str
    job: str = ""
    runs: bool = False
    taken: int = 0
    parameters: dict[str, float | bool | str] = field(default_factory=dict)
    exposure: dict[str, float] = field(default_factory=dict)
    results: list[tuple[float, CameraTarget]] = field(default_factory=list)
    """Those nobody has fetched, and when [s] they are there."""


def camera_state(script: CameraScript) -> CameraState:
    """A camera as it is when the run begins."""
    return CameraState(script, script.name, parameters=dict(script.parameters))
