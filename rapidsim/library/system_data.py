r"""Queries about the controller and the active tool.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "GetSysInfo",
"GetSysData", "SetSysData", "EventType", "UIClientExist", "IsSysId", "ProgMemFree".
"""

from __future__ import annotations

from dataclasses import replace

from rapidsim.language.annotations import (
    AnyType,
    ArgumentType,
    Bool,
    EventTypeNum,
    ExecLevelNum,
    InOut,
    Num,
    Pers,
    String,
    Switch,
    TaskId,
    TpNum,
    Var,
)
from rapidsim.language.controller import Controller, FidelityReporter, Interrupts
from rapidsim.language.data import LOAD0, LoadData, ToolData, WobjData
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.errors import RapidError
from rapidsim.language.types import NUM, Type
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.predefined import DATA
from rapidsim.library.table import routine, table
from rapidsim.library.task_arguments import means_another
from rapidsim.library.traits import Trait

NORMAL_LEVEL, TRAP_LEVEL = 0.0, 1.0
"""The constants LEVEL_NORMAL and LEVEL_TRAP."""
NO_EVENT = 0.0
"""The constant EVENT_NONE: the program runs normally, not for an event such as power on."""

FREE_MEMORY_BYTES = 2.0**26
_MEMORY_NOTE = "64 MB, whatever is loaded"
_VIRTUAL = "virtual"
_NAME = "rapidsim"


def get_sys_info(
    *,
    serial_no: Switch = False,
    sw_version: Switch = False,
    sw_version_name: Switch = False,
    robot_type: Switch = False,
    ctrl_id: Switch = False,
    lan_ip: Switch = False,
    ctrl_lang: Switch = False,
    system_name: Switch = False,
) -> String:
    """System data of a virtual controller, which has no serial number or other hardware data."""
    answers = (
        (serial_no or sw_version or robot_type, _VIRTUAL),
        (sw_version_name or ctrl_id or system_name, _NAME),
        (lan_ip, "127.0.0.1"),
        (ctrl_lang, "en"),
    )
    return next((answer for asked, answer in answers if asked), "")


def is_sys_id(system_id: String) -> Bool:
    """Whether the controller has this identity."""
    return system_id == _NAME


def prog_mem_free(controller: FidelityReporter) -> Num:
    """The free program memory in bytes, a constant in a run."""
    controller.not_simulated("ProgMemFree", _MEMORY_NOTE)
    return FREE_MEMORY_BYTES


def get_sys_data(
    controller: Controller,
    dest_object: Pers[AnyType],
    *,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
    object_name: InOut[String] | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Copy the active tool, work object or load of the gripper, and store its name."""
    if means_another(controller.tasks, task_ref, task_name):
        note_ignored_options(
            controller.fidelity, "GetSysData", {r"\TaskRef": task_ref, r"\TaskName": task_name}
        )
    motion = controller.motion
    tool, wobj = motion.active_names()
    match of.name:
        case "tooldata":
            dest_object.value, name = motion.active_tool(), tool
        case "wobjdata":
            dest_object.value, name = motion.active_wobj(), wobj
        case "loaddata":
            name = motion.settings.grip_load_name
            dest_object.value = motion.settings.grip_load or LOAD0
        case other:
            raise _no_active(other)
    if object_name is not None:
        object_name.value = name


def set_sys_data(
    controller: Controller,
    source_object: Pers[AnyType],
    *,
    object_name: String | None = None,
    of: ArgumentType = NUM,
) -> None:
    """Activate a tool, a work object or a load, as a move or GripLoad does.

    A name replaces the source object, which then only determines the type of the data.
    """
    value = source_object.value
    name = controller.clock.place.arguments.get("sourceobject", "")
    if object_name is not None:
        value, name = _named(controller, object_name, of), object_name
    match value:
        case ToolData() | WobjData() as data:
            controller.motion.activate(data, name)
        case LoadData() as load:
            controller.motion.settings = replace(
                controller.motion.settings, grip_load=load, grip_load_name=name
            )
        case _:
            raise _no_active(of.name)


def _named(controller: Controller, name: str, of: Type) -> object:
    """Data by name: predefined, otherwise of the program."""
    predefined = DATA.get(name.lower())
    if predefined is not None and predefined.type == of:
        return predefined.value
    return controller.symbols.read(name, of, None)


def _no_active(of: str) -> RapidError:
    return rapid_error(
        ERR_ARGVALERR, f"there is no active {of}; tooldata, wobjdata and loaddata are possible"
    )


def event_type() -> EventTypeNum:
    """The event whose routine runs: none in a run."""
    return NO_EVENT


def ui_client_exist() -> Bool:
    """Whether a FlexPendant is connected; scripted answers count as one."""
    return True


def exec_level(controller: Interrupts) -> ExecLevelNum:
    """Whether the program runs at its normal level, 0, or a trap, 1."""
    return TRAP_LEVEL if controller.in_trap else NORMAL_LEVEL


def pp_moved_in_man_mode() -> Bool:
    """Whether the program pointer was moved by hand, which never happens in a run."""
    return False


def reset_pp_moved() -> None:
    """Clear the note that the program pointer was moved; has no effect in a run."""


def is_stop_state_event(*, pp_moved: Switch = False, pp_to_main: Switch = False) -> Bool:
    """Whether the program pointer was moved during a stop, which never happens in a run."""
    del pp_moved, pp_to_main
    return False


def pf_restart(*, base: Switch = False, irpt: Switch = False) -> Bool:
    """Whether the program continues after a power failure, which never happens in a run."""
    del base, irpt
    return False


def tp_show(window: TpNum) -> None:
    """Choose the view of the FlexPendant; every text is in the events of the run anyway."""
    del window


SYSTEM_DATA = table(
    routine(
        "GetSysInfo",
        get_sys_info,
        r"\SerialNo|\SWVersion|\SWVersionName|\RobotType|\CtrlId|\LanIp|\CtrlLang|\SystemName",
    ),
    routine("IsSysId", is_sys_id),
    routine("ProgMemFree", prog_mem_free, treated_as=_MEMORY_NOTE),
    routine("GetSysData", get_sys_data, r"\TaskRef|\TaskName DestObject \ObjectName"),
    routine(
        "SetSysData",
        set_sys_data,
        r"SourceObject \ObjectName",
        sets=("grip_load", "grip_load_name"),
    ),
    routine("EventType", event_type),
    routine("UIClientExist", ui_client_exist),
    routine("ExecLevel", exec_level),
    routine("PPMovedInManMode", pp_moved_in_man_mode),
    routine("ResetPPMoved", reset_pp_moved),
    routine("IsStopStateEvent", is_stop_state_event, r"\PPMoved \PPToMain"),
    routine("PFRestart", pf_restart, r"\Base|\Irpt"),
    routine("TPShow", tp_show, does=Trait.TELL),
)
