r"""Cameras: pictures with results from the station's [[camera]] tables.

Calls for a camera that the station does not describe are skipped and reported. Exposure and
parameters can be read back, but do not affect the results.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "CamReqImage",
"CamGetResult", "CamNumberOfResults", "CamSetRunMode", "CamGetParameter"; Application manual
Integrated Vision.
"""

from __future__ import annotations

from rapidsim.language.annotations import Bool, CameraDev, Num, String, Switch, Var
from rapidsim.language.cameras import Camera
from rapidsim.language.controller import ClockService, Controller
from rapidsim.language.error_numbers import (
    ERR_CAM_GET_MISMATCH,
    ERR_CAM_MAXTIME,
    ERR_CAM_NO_MORE_DATA,
    ERR_CAM_NO_PROGMODE,
    ERR_CAM_NO_RUNMODE,
    ERR_CAM_SET_MISMATCH,
    rapid_error,
)
from rapidsim.language.option_data import CameraTarget
from rapidsim.language.reference import Reference
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

_NOT_THERE = "skipped: the station has no [[camera]] of that name"


def cam_set_program_mode(controller: Controller, camera: Var[CameraDev]) -> None:
    """Put a camera into program mode, in which it takes no pictures."""
    if (found := _camera(controller, "CamSetProgramMode", camera)) is not None:
        found.runs = False


def cam_set_run_mode(controller: Controller, camera: Var[CameraDev]) -> None:
    """Put a camera into run mode, in which it takes pictures."""
    if (found := _camera(controller, "CamSetRunMode", camera)) is not None:
        found.runs = True


def cam_load_job(
    controller: Controller,
    camera: Var[CameraDev],
    job_name: String,
    *,
    keep_targets: Switch = False,
    max_time: Num | None = None,
) -> None:
    """Load a job into a camera; no time passes."""
    del max_time
    _load(controller, "CamLoadJob", camera, job_name, keep_targets)


def cam_start_load_job(
    controller: Controller,
    camera: Var[CameraDev],
    name: String,
    *,
    keep_targets: Switch = False,
) -> None:
    """Start loading a job into a camera; it is loaded immediately."""
    _load(controller, "CamStartLoadJob", camera, name, keep_targets)


def cam_wait_load_job(camera: Var[CameraDev]) -> None:
    """Wait until a job is loaded, which is already the case."""
    del camera


def cam_get_loaded_job(controller: Controller, camera: Var[CameraDev]) -> String:
    """The name of the job that is loaded in a camera."""
    found = _camera(controller, "CamGetLoadedJob", camera)
    return "" if found is None else found.job


def cam_get_name(controller: Controller, camera: Var[CameraDev]) -> String:
    """The name of a camera in the configuration."""
    return _name(controller, camera)


def cam_req_image(
    controller: Controller,
    camera: Var[CameraDev],
    *,
    scene_id: Var[Num] | None = None,
    keep_targets: Switch = False,
    await_complete: Switch = False,
) -> None:
    """Take a picture; its results are available after the time of the script."""
    found = _camera(controller, "CamReqImage", camera)
    if found is None:
        return
    if not found.runs:
        raise rapid_error(ERR_CAM_NO_RUNMODE, f"the camera {found.name} is not in run mode")
    if not keep_targets:
        controller.cameras.forget(found)
    takes_s = controller.cameras.take_picture(found)
    if scene_id is not None:
        scene_id.value += 1.0
    if await_complete:
        controller.clock.wait(takes_s)


def cam_get_result(
    controller: Controller,
    camera: Var[CameraDev],
    cam_target: Var[CameraTarget],
    *,
    scene_id: Num | None = None,
    max_time: Num | None = None,
) -> None:
    """Fetch the next result, waiting while a picture is being processed."""
    del scene_id
    found = _camera(controller, "CamGetResult", camera)
    if found is None:
        return
    cameras = controller.cameras

    def is_decided() -> bool:
        return bool(cameras.result_count(found)) or not cameras.expects(found)

    if not controller.signals.wait_until(is_decided, max_time=max_time, poll_s=_LOOKS_EVERY_S):
        raise rapid_error(ERR_CAM_MAXTIME, f"no result of {found.name} in {max_time or 0.0:g} s")
    target = cameras.fetch(found)
    if target is None:
        raise rapid_error(ERR_CAM_NO_MORE_DATA, f"the camera {found.name} has no more results")
    cam_target.value = target


def cam_number_of_results(
    controller: Controller, camera: Var[CameraDev], *, scene_id: Num | None = None
) -> Num:
    """The number of results that can be fetched."""
    del scene_id
    found = _camera(controller, "CamNumberOfResults", camera)
    return 0.0 if found is None else float(controller.cameras.result_count(found))


def cam_flush(controller: Controller, camera: Var[CameraDev]) -> None:
    """Discard the results that have not been fetched."""
    if (found := _camera(controller, "CamFlush", camera)) is not None:
        controller.cameras.forget(found)


_LOOKS_EVERY_S = 0.01


def _load(
    controller: Controller, name: str, camera: Reference[object], job: str, keep_targets: bool
) -> None:
    found = _camera(controller, name, camera)
    if found is None:
        return
    if found.runs:
        raise rapid_error(ERR_CAM_NO_PROGMODE, f"the camera {found.name} is not in program mode")
    found.job = job
    if not keep_targets:
        controller.cameras.forget(found)


def _camera(controller: Controller, routine: str, camera: Reference[object]) -> Camera | None:
    """Camera that an argument names; None, and a report, if the station has no such camera."""
    found = controller.cameras.camera(_name(controller, camera))
    if found is None:
        controller.fidelity.not_simulated(routine, _NOT_THERE)
    return found


def _name(controller: Controller, camera: Reference[object]) -> str:
    """Name of a camera in the configuration: the argument of AliasCamera, or the variable's own."""
    written = controller.clock.place.arguments.get("camera", "")
    return camera.value if isinstance(camera.value, str) else written


def cam_set_parameter(
    controller: Controller,
    camera: Var[CameraDev],
    par_name: String,
    *,
    num_val: Num | None = None,
    bool_val: Bool | None = None,
    str_val: String | None = None,
) -> None:
    """Set a parameter of the job in a camera."""
    found = _camera(controller, "CamSetParameter", camera)
    if found is None:
        return
    given = next((one for one in (num_val, bool_val, str_val) if one is not None), None)
    value = found.parameters.get(par_name.lower())
    if given is None or type(value) is not type(given):
        raise rapid_error(ERR_CAM_SET_MISMATCH, _mismatch(found, par_name, value))
    found.parameters[par_name.lower()] = given


def cam_get_parameter(
    controller: Controller,
    camera: Var[CameraDev],
    par_name: String,
    *,
    num_var: Var[Num] | None = None,
    bool_var: Var[Bool] | None = None,
    str_var: Var[String] | None = None,
) -> None:
    """Read a parameter of the job in a camera."""
    found = _camera(controller, "CamGetParameter", camera)
    if found is None:
        return
    value = found.parameters.get(par_name.lower())
    if num_var is not None and isinstance(value, float):
        num_var.value = value
    elif bool_var is not None and isinstance(value, bool):
        bool_var.value = value
    elif str_var is not None and isinstance(value, str):
        str_var.value = value
    else:
        raise rapid_error(ERR_CAM_GET_MISMATCH, _mismatch(found, par_name, value))


def cam_set_exposure(
    controller: Controller,
    camera: Var[CameraDev],
    *,
    exposure_time: Num | None = None,
    brightness: Num | None = None,
    contrast: Num | None = None,
) -> None:
    """Set how a camera exposes its pictures."""
    found = _camera(controller, "CamSetExposure", camera)
    if found is not None:
        given = {_TIME: exposure_time, _BRIGHTNESS: brightness, _CONTRAST: contrast}
        found.exposure.update((of, value) for of, value in given.items() if value is not None)


def cam_get_exposure(
    controller: Controller,
    camera: Var[CameraDev],
    *,
    exposure_time: Switch = False,
    brightness: Switch = False,
    contrast: Switch = False,
) -> Num:
    """The exposure setting of a camera, as set by CamSetExposure."""
    del exposure_time
    found = _camera(controller, "CamGetExposure", camera)
    if found is None:
        return 0.0
    of = _BRIGHTNESS if brightness else _CONTRAST if contrast else _TIME
    if of not in found.exposure:
        controller.fidelity.not_simulated(
            f"CamGetExposure of {found.name}", "0: nothing has set it"
        )
    return found.exposure.get(of, 0.0)


_TIME, _BRIGHTNESS, _CONTRAST = "ExposureTime", "Brightness", "Contrast"
_WORDS = {float: "a num", bool: "a bool", str: "a string"}


def _mismatch(camera: Camera, name: str, value: float | bool | str | None) -> str:
    if value is None:
        return f"the station gives no parameter `{name}` of the camera {camera.name}"
    return f"`{name}` of the camera {camera.name} is {_WORDS[type(value)]}"


def alias_camera(
    controller: ClockService, camera_name: String | CameraDev, to_camera: Var[CameraDev]
) -> None:
    """Make a variable an alias of a camera, identified by its name or by another variable."""
    written = controller.place.arguments.get("cameraname", "")
    to_camera.value = camera_name if isinstance(camera_name, str) else written


CAMERAS = table(
    routine("AliasCamera", alias_camera),
    routine("CamFlush", cam_flush),
    routine("CamGetExposure", cam_get_exposure, r"Camera \ExposureTime|\Brightness|\Contrast"),
    routine("CamGetLoadedJob", cam_get_loaded_job),
    routine("CamGetName", cam_get_name),
    routine("CamGetParameter", cam_get_parameter, r"Camera ParName \NumVar|\BoolVar|\StrVar"),
    routine(
        "CamGetResult", cam_get_result, r"Camera CamTarget \SceneId \MaxTime", does=Trait.GIVE_UP
    ),
    routine(
        "CamLoadJob", cam_load_job, r"Camera JobName \KeepTargets \MaxTime", does=Trait.GIVE_UP
    ),
    routine("CamNumberOfResults", cam_number_of_results),
    routine(
        "CamReqImage",
        cam_req_image,
        r"Camera \SceneId \KeepTargets \AwaitComplete",
        does=Trait.WAIT,
    ),
    routine("CamSetExposure", cam_set_exposure),
    routine("CamSetParameter", cam_set_parameter, r"Camera ParName \NumVal|\BoolVal|\StrVal"),
    routine("CamSetProgramMode", cam_set_program_mode),
    routine("CamSetRunMode", cam_set_run_mode),
    routine("CamStartLoadJob", cam_start_load_job),
    routine("CamWaitLoadJob", cam_wait_load_job, does=Trait.WAIT),
)
