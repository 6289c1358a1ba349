"""Scripted cameras of a cell: the results in successive pictures.

Plain data, read from the station file or the file that `--io` names.
"""

from __future__ import annotations

from dataclasses import field

from rapidsim.language.option_data import CameraTarget
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class CameraScript:
    """A camera with its scripted results."""

    name: str
    pictures: tuple[tuple[CameraTarget, ...], ...]
    """The results found in each picture."""
    after_s: float = 0.0
    """Time from the request for a picture to its results."""
    repeats: bool = False
    """Whether the pictures repeat after the last one; otherwise later ones show nothing."""
    parameters: tuple[tuple[str, float | bool | str], ...] = ()
    """The parameters of its job, by folded name, with their initial values."""


@value_class(slots=True, eq=False)
class CameraState:
    """State of a camera during a run; implements `language.cameras.Camera`."""

    script: CameraScript
    name: str
    job: str = ""
    runs: bool = False
    image_count: int = 0
    parameters: dict[str, float | bool | str] = field(default_factory=dict)
    exposure: dict[str, float] = field(default_factory=dict)
    results: list[tuple[float, CameraTarget]] = field(default_factory=list)
    """Results not yet fetched, with the time [s] at which each is available."""


def camera_state(script: CameraScript) -> CameraState:
    """A camera in its state at the start of the run."""
    return CameraState(script, script.name, parameters=dict(script.parameters))
