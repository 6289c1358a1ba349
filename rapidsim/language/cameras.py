"""Cameras of the cell, as programs use them."""

from __future__ import annotations

from typing import Protocol

from rapidsim.language.option_data import CameraTarget


class Camera(Protocol):
    """A camera and its state."""

    name: str
    job: str
    runs: bool
    """Whether it is in run mode; only then it takes pictures."""
    parameters: dict[str, float | bool | str]
    """What its job can be set to, by folded name."""
    exposure: dict[str, float]
    """What CamSetExposure set, by the name of the optional argument."""


class Cameras(Protocol):
    """The cameras that the station describes."""

    def camera(self, name: str) -> Camera | None:
        """A camera by its name without case; None where the station has none of that name."""
        ...

    def take_picture(self, camera: Camera) -> float:
        """Take the next picture of the script; how long until its results are there [s]."""
        ...

    def result_count(self, camera: Camera) -> int:
        """How many results can be fetched now."""
        ...

    def fetch(self, camera: Camera) -> CameraTarget | None:
        """The next result; None while there is none."""
        ...

    def expects(self, camera: Camera) -> bool:
        """Whether results of a picture are still to come."""
        ...

    def forget(self, camera: Camera) -> None:
        """Discard results that were not fetched."""
        ...
