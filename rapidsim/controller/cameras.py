"""The cameras of the cell, as one task uses them."""

from __future__ import annotations

from rapidsim.controller.cell.camera_scripts import CameraState
from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.language.cameras import Camera
from rapidsim.language.option_data import CameraTarget
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TaskCameras:
    """Implements `language.cameras.Cameras`."""

    clock: TaskClock
    cell: Cell

    def camera(self, name: str) -> CameraState | None:
        """A camera by name, ignoring case."""
        return self.cell.cameras.get(name.lower())

    def take_picture(self, camera: Camera) -> float:
        """Take the next picture of the script."""
        now_s, state = self.clock.synchronise(), self._state(camera)
        script, number = state.script, state.image_count
        state.image_count += 1
        if script.repeats and script.pictures:
            number %= len(script.pictures)
        shown = script.pictures[number] if number < len(script.pictures) else ()
        there_s = now_s + script.after_s
        state.results += ((there_s, target) for target in shown)
        return script.after_s

    def result_count(self, camera: Camera) -> int:
        """The number of results that can be fetched now."""
        now_s = self.clock.synchronise()
        return sum(there_s <= now_s for there_s, _ in self._state(camera).results)

    def fetch(self, camera: Camera) -> CameraTarget | None:
        """The next result."""
        if not self.result_count(camera):
            return None
        return self._state(camera).results.pop(0)[1]

    def expects(self, camera: Camera) -> bool:
        """Whether results of a picture are still to arrive."""
        return len(self._state(camera).results) > self.result_count(camera)

    def forget(self, camera: Camera) -> None:
        """Discard the results that have not been fetched."""
        self._state(camera).results.clear()

    def _state(self, camera: Camera) -> CameraState:
        return self.cell.cameras[camera.name.lower()]
