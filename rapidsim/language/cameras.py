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
    """Settings of its job, by folded name."""
    exposure: dict[str, float]
    """Settings by CamSetExposure, by the name of the optional argument."""


class Cameras(Protocol):
    """The cameras that the station describes."""

    def camera(self, name: str) -> Camera | None:
        """A camera by its name, ignoring case; None if the station does not have it."""
        ...

    def take_picture(self, camera: Camera) -> float:
        """Take the next picture of the script; return the time [s] until it has results."""
        ...

    def result_count(self, camera: Camera) -> int:
        """Number of results that can be fetched now."""
        ...

    def fetch(self, camera: Camera) -> CameraTarget | None:
        """Fetch the next result; None if none is available."""
        ...

    def expects(self, camera: Camera) -> bool:
        """Whether results of a picture are still to arrive."""
        ...

    def forget(self, camera: Camera) -> None:
        """Discard results that were not fetched."""
        ...
