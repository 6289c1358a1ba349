"""Resources of Robot Web Services and the functions that answer them.

Both generations have the same resources. RobotWare 7 has the action in the address, RobotWare 6 in
the query, and some resources have other addresses in RobotWare 7.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from rapidsim.server.messages import Answer, Item, Request
from rapidsim.server.resources import (
    backups,
    configuration,
    control_stations,
    event_log,
    files,
    hardware,
    jogging,
    kinematics,
    motion,
    panel,
    programs,
    questions,
    queues,
    return_codes,
    signals,
    symbols,
    system,
)
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, as_answered, refused
from rapidsim.server.resources.context import RequestContext
from rapidsim.server.resources.route import Route
from rapidsim.simulation.live.states import RequestRefused

_SIGNAL: Final = ("rw/iosystem/signals/{name}", "rw/iosystem/signals/{network}/{device}/{name}")
_UNIT: Final = "rw/motionsystem/mechunits/{unit}"
_EXECUTION: Final = "rw/rapid/execution"
_TASK: Final = "rw/rapid/tasks/{task}"
_FILE: Final = "fileservice/{address...}"
_SYMBOL: Final = "rw/rapid/symbol/data/RAPID/{symbol...}"
_SYMBOL_2: Final = "rw/rapid/symbol/RAPID/{symbol...}"
_INSTANCES: Final = "rw/cfg/{domain}/{of}/instances"
_ACTIVE: Final = "rw/rapid/uiinstr/active"

_BOTH: Final = (
    Route("GET", "ctrl", system.controller),
    Route("GET", "ctrl/identity", system.identity),
    Route("GET", "ctrl/clock", system.clock),
    Route("PUT", "ctrl/clock", system.set_clock),
    Route("GET", "ctrl/${name}", system.disk),
    Route("GET", "ctrl/backup", backups.information),
    Route("GET", "progress", backups.operations),
    Route("GET", "progress/{number}", backups.operation),
    Route("GET", "rw/system", system.system),
    Route("GET", "rw/system/options", system.options),
    Route("GET", "rw/system/robottype", system.robot_type),
    Route("GET", "rw/system/license", system.license_),
    Route("GET", "rw/retcode", return_codes.return_codes),
    Route("GET", "rw/devices", hardware.groups),
    Route("GET", "rw/devices/{name}", hardware.group),
    Route("GET", "rw/panel/opmode", panel.mode),
    Route("GET", "rw/panel/speedratio", panel.speed_ratio),
    Route("POST", "rw/panel/speedratio", panel.set_speed_ratio, "setspeedratio"),
    Route("GET", "rw/panel/coldetstate", panel.collision_detection),
    Route("GET", _EXECUTION, programs.execution),
    Route("GET", "rw/rapid/tasks", programs.tasks),
    Route("GET", "rw/rapid/tasks/spy", programs.spy),
    Route("GET", _TASK, programs.task),
    Route("GET", f"{_TASK}/pcp", programs.pointers),
    Route("GET", f"{_TASK}/program", programs.program),
    Route("GET", f"{_TASK}/motion", motion.of_task),
    Route("GET", _ACTIVE, questions.active),
    Route("GET", "rw/iosystem/signals", signals.signals),
    *(Route("GET", one, signals.signal) for one in _SIGNAL),
    Route("GET", "rw/iosystem/networks", signals.networks),
    Route("GET", "rw/iosystem/devices", signals.devices),
    Route("GET", "rw/motionsystem", motion.motion_system),
    Route("GET", "rw/motionsystem/errorstate", motion.error_state),
    Route("GET", "rw/motionsystem/nonmotionexecution", motion.non_motion_execution),
    Route("GET", "rw/motionsystem/mechunits", motion.units),
    Route("GET", _UNIT, motion.unit),
    Route("GET", f"{_UNIT}/jointtarget", motion.joint_target),
    Route("GET", f"{_UNIT}/robtarget", motion.rob_target),
    Route("GET", f"{_UNIT}/cartesian", motion.cartesian),
    Route("GET", f"{_UNIT}/baseframe", motion.base_frame),
    Route("GET", f"{_UNIT}/axes", motion.axes),
    Route("GET", f"{_UNIT}/axes/{{number}}", motion.axis),
    Route("GET", "rw/elog", event_log.domains),
    Route("GET", "rw/elog/{domain}", event_log.entries),
    Route("GET", "rw/elog/{domain}/{number}", event_log.entry),
    Route("GET", "rw/cfg", configuration.domains),
    Route("GET", "rw/cfg/{domain}", configuration.types),
    Route("GET", "rw/cfg/{domain}/{of}", configuration.type_),
    Route("GET", _INSTANCES, configuration.instances),
    Route("GET", f"{_INSTANCES}/{{name}}", configuration.instance),
    Route("GET", "rw/dipc", queues.queues),
    Route("GET", "fileservice", files.disks),
    Route("GET", _FILE, files.read),
    Route("PUT", _FILE, files.write),
    Route("DELETE", _FILE, files.remove),
    Route("POST", _FILE, files.change),
    Route("GET", "rw/mastership", system.mastership),
    Route("GET", "rw/mastership/{domain}", system.mastership_of),
    Route("GET", "users", system.users),
    Route("POST", "users", system.register),
    Route("POST", "users/rmmp", system.remote_rights),
    Route("GET", "users/rmmp", system.rights),
    Route("GET", "users/rmmp/poll", system.rights_granted),
)

_FIRST: Final = (
    Route("GET", "ctrl/backup", backups.state, "backupstate"),
    Route("POST", "ctrl/backup", backups.create, "backup"),
    Route("GET", "rw/panel/ctrlstate", panel.state),
    Route("POST", "rw/panel/ctrlstate", panel.set_state, "setctrlstate"),
    Route("POST", "rw/panel/opmode", panel.set_mode, "setopmode"),
    Route("POST", "rw/motionsystem", jogging.jog, "jog"),
    Route("POST", _UNIT, kinematics.pose_from_joints, "CalcPoseFromJoints"),
    Route("POST", _UNIT, kinematics.joints_from_cartesian, "JointsFromCartesian"),
    Route("POST", _UNIT, kinematics.all_joint_solutions, "AllJointSolutions"),
    Route("POST", "rw/panel", panel.restart, "restart"),
    Route("POST", "rw/panel", panel.set_emergency_stop, "emergencystop"),
    Route("POST", _EXECUTION, programs.start, "start"),
    Route("POST", _EXECUTION, programs.start_production, "startprodentry"),
    Route("POST", _EXECUTION, programs.stop, "stop"),
    Route("POST", _EXECUTION, programs.reset_pointers, "resetpp"),
    Route("POST", _EXECUTION, programs.set_cycle, "setcycle"),
    Route("POST", "rw/rapid/tasks", programs.activate, "activate"),
    Route("POST", "rw/rapid/tasks", programs.deactivate, "deactivate"),
    Route("POST", _TASK, programs.activate, "activate"),
    Route("POST", _TASK, programs.deactivate, "deactivate"),
    Route("POST", _TASK, programs.load_module, "loadmod"),
    Route("POST", _TASK, programs.unload_module, "unloadmod"),
    Route("POST", f"{_TASK}/program", programs.load_program, "loadprog"),
    Route("POST", f"{_TASK}/pcp", programs.put_pointer, "set-pp-routine"),
    Route("POST", f"{_TASK}/breakpoints", programs.set_breakpoint, "set"),
    Route("POST", f"{_TASK}/breakpoints", programs.clear_breakpoint, "clear"),
    Route("GET", "rw/rapid/modules", programs.modules),
    Route("GET", "rw/rapid/modules/{module}", programs.module),
    Route("POST", "rw/rapid/modules/{module}", programs.save_module, "save"),
    Route("GET", _SYMBOL, symbols.value),
    Route("POST", _SYMBOL, symbols.set_value, "set"),
    Route("POST", "rw/rapid/symbol/data", symbols.validate, "validate"),
    Route("GET", "rw/rapid/symbol/properties/RAPID/{symbol...}", symbols.properties),
    Route("POST", "rw/rapid/symbols", symbols.search, "search-symbols"),
    Route("POST", f"{_ACTIVE}/param/{{parameter...}}", questions.answer, "set"),
    Route("POST", "rw/iosystem/signals", signals.search, "signal-search"),
    *(Route("POST", one, signals.set_signal, "set") for one in _SIGNAL),
    Route("POST", "rw/elog", event_log.clear_all, "clearall"),
    Route("POST", "rw/elog/{domain}", event_log.clear, "clear"),
    Route("POST", f"{_INSTANCES}/{{name}}", configuration.change, "set"),
    # Older clients omit the prefix.
    Route("POST", "rw/dipc", queues.create, "dipc-create"),
    Route("POST", "rw/dipc", queues.create, "create"),
    Route("GET", "rw/dipc/{queue}", queues.read, "dipc-read"),
    Route("GET", "rw/dipc/{queue}", queues.read, "read"),
    Route("GET", "rw/dipc/{queue}", queues.queue),
    Route("POST", "rw/dipc/{queue}", queues.send, "dipc-send"),
    Route("POST", "rw/dipc/{queue}", queues.send, "send"),
    Route("POST", "rw/mastership", system.take_mastership, "request"),
    # A public client omits the action.
    Route("POST", "rw/mastership", system.take_mastership),
    Route("POST", "rw/mastership", system.give_mastership, "release"),
    Route("POST", "rw/mastership/{domain}", system.take_mastership, "request"),
    Route("POST", "rw/mastership/{domain}", system.give_mastership, "release"),
    Route("POST", "users/rmmp", system.release_rights, "cancel"),
)

_SECOND: Final = (
    Route("GET", "ctrl/backup/state", backups.state),
    Route("POST", "ctrl/backup/create", backups.create),
    Route("GET", "rw/panel/ctrl-state", panel.state),
    Route("POST", "rw/panel/ctrl-state", panel.set_state),
    Route("POST", "rw/panel/opmode", panel.set_mode),
    Route("POST", "ctrl/restart", panel.restart),
    Route("POST", f"{_UNIT}/pose-from-joints", kinematics.pose_from_joints),
    Route("POST", f"{_UNIT}/joints-from-cartesian", kinematics.joints_from_cartesian),
    Route("POST", f"{_UNIT}/all-joints-solution", kinematics.all_joint_solutions),
    Route("POST", "rw/panel/emergency-stop", panel.set_emergency_stop),
    Route("POST", f"{_EXECUTION}/start", programs.start),
    Route("POST", f"{_EXECUTION}/startprodentry", programs.start_production),
    Route("POST", f"{_EXECUTION}/stop", programs.stop),
    Route("POST", f"{_EXECUTION}/resetpp", programs.reset_pointers),
    Route("POST", f"{_EXECUTION}/cycle", programs.set_cycle),
    Route("POST", "rw/rapid/tasks/activate", programs.activate),
    Route("POST", "rw/rapid/tasks/deactivate", programs.deactivate),
    Route("POST", f"{_TASK}/activate", programs.activate),
    Route("POST", f"{_TASK}/deactivate", programs.deactivate),
    Route("GET", f"{_TASK}/modules", programs.modules),
    Route("GET", f"{_TASK}/modules/{{module}}", programs.module),
    Route("GET", f"{_TASK}/modules/{{module}}/text", programs.module_text),
    Route("POST", f"{_TASK}/modules/{{module}}/save", programs.save_module),
    Route("POST", f"{_TASK}/loadmod", programs.load_module),
    Route("POST", f"{_TASK}/unloadmod", programs.unload_module),
    Route("POST", f"{_TASK}/program/load", programs.load_program),
    Route("POST", f"{_TASK}/pcp/routine", programs.put_pointer),
    Route("POST", f"{_TASK}/pcp/reset", programs.reset_pointers),
    Route("GET", f"{_SYMBOL_2}/data", symbols.value),
    Route("POST", f"{_SYMBOL_2}/data", symbols.set_value),
    Route("GET", f"{_SYMBOL_2}/properties", symbols.properties),
    Route("POST", "rw/rapid/symbol/data", symbols.validate, "validate"),
    Route("POST", "rw/rapid/symbols/search", symbols.search),
    Route("POST", f"{_ACTIVE}/param/{{parameter...}}", questions.answer),
    Route("POST", "rw/iosystem/signals/signal-search", signals.search),
    *(Route("POST", f"{one}/set-value", signals.set_signal) for one in _SIGNAL),
    Route(
        "POST", "rw/iosystem/devices/{network}/{device}/set-inputdata", signals.set_device_inputs
    ),
    Route("GET", "rw/elog/seqnum/{number}", event_log.entry),
    Route("POST", "rw/elog/clearall", event_log.clear_all),
    Route("POST", "rw/elog/{domain}/clear", event_log.clear),
    Route("POST", f"{_INSTANCES}/{{name}}", configuration.change),
    Route("POST", "rw/dipc", queues.create),
    Route("GET", "rw/dipc/{queue}", queues.read),
    Route("POST", "rw/dipc/{queue}", queues.send),
    Route("POST", "rw/mastership/request", system.take_mastership),
    Route("POST", "rw/mastership/release", system.give_mastership),
    Route("POST", "rw/mastership/{domain}/request", system.take_mastership),
    Route("POST", "rw/mastership/{domain}/release", system.give_mastership),
    Route("POST", "users/rmmp/cancel", system.release_rights),
    Route("GET", "uas/ldap/enabled", system.for_administrators),
    # Older clients request the end of streams; rapidsim has none.
    Route("POST", "rw/infostream/disconnectclient", system.nothing_to_end),
    Route("POST", "rw/_istream/streamdisconnect", system.nothing_to_end),
)

_STATION: Final = "rw/controlstation"
_ACCESS: Final = f"{_STATION}/writeaccess"
_MASTERSHIP: Final = ("rw/mastership", "rw/mastership/{rest...}")
_EIGHTH: Final = (
    *(
        Route(method, one, control_stations.no_mastership)
        for one in _MASTERSHIP
        for method in ("GET", "POST")
    ),
    Route("POST", f"{_STATION}/register/remote", control_stations.register),
    Route("POST", f"{_ACCESS}/request", control_stations.request_access),
    Route("POST", f"{_ACCESS}/release", control_stations.release_access),
    Route("POST", f"{_ACCESS}/release/appeal", control_stations.appeal),
    Route("GET", f"{_ACCESS}/release/appeal/changecount", control_stations.appeals),
    Route("GET", f"{_ACCESS}/status", control_stations.access_status),
    Route("GET", f"{_STATION}/type", control_stations.type_),
    Route("GET", f"{_STATION}/id", control_stations.identity),
    *(
        Route("GET", f"{_STATION}/{path}", control_stations.constant(kind, title, name, value))
        for path, kind, title, name, value in (
            (
                "local/isconnected",
                "controlstation-local-connected",
                "isconnected",
                "control-station-local-isconnected",
                "false",
            ),
            # So spelt by controllers.
            (
                "allowmotioncontrol",
                "controstation-allow-motion-control",
                "allowmotioncontrol",
                "is-enabled",
                "true",
            ),
            (
                "tpu/safety/protocol/status",
                "controlstation-tpu-safety-protocol-status",
                "status",
                "is-connected",
                "false",
            ),
        )
    ),
)

ROUTES: Final[Mapping[int, tuple[Route, ...]]] = {
    6: (*_FIRST, *_BOTH),
    7: (*_SECOND, *_BOTH),
    8: (*_EIGHTH, *_SECOND, *_BOTH),
}
"""Routes by version of RobotWare; if several match an address, the first counts."""

_INDEX_KINDS: Final = {
    "": "srvlst-service-li",
    "rw": "rwservice-li",
    "rw/panel": "pnl-{}-li",
    "rw/iosystem": "ios-{}-li",
    "rw/rapid": "rap-{}-li",
    "rw/rapid/uiinstr": "rap-{}-li",
}
"""Classes of the resources below an address that is no resource itself, with their names."""


def answered(context: RequestContext, request: Request) -> Answer:
    """Answer a request.

    Raises:
        RefusedRequest: If there is no such resource or action, or it is refused.
    """
    context.sessions.setdefault(request.session, "")
    parts = [part for part in request.path.split("/") if part]
    version = 6 if request.generation == 1 else 7
    routes = ROUTES[8 if version == 7 and context.has_control_stations else version]
    there = is_readable = False
    for route in routes:
        places = route.matched(parts)
        if places is None:
            continue
        there, is_readable = True, is_readable or route.method == "GET"
        if route.method == request.method and route.action == request.action:
            try:
                return route.resource(context, request, **places)
            except RequestRefused as refusal:
                raise as_answered(refusal, request.generation) from None
    below = tuple(dict.fromkeys(_below(routes, parts)))
    if below and request.method == "GET" and not is_readable:
        return _index("/".join(parts), below)
    if there:
        raise refused(BAD_PARAMETER, f"{request.method} {request.path}: no such action here")
    raise refused(NOT_FOUND, f"there is no resource {request.path}")


def _index(address: str, names: tuple[str, ...]) -> Answer:
    """Return the resources below an address that is no resource itself."""
    kind = _INDEX_KINDS.get(address)
    if kind is None:
        return Answer(links=names)
    prefix = f"{address}/" if address else ""
    listed = tuple(Item(kind.format(one), one, href=f"{prefix}{one}") for one in names)
    # The addresses in the list of services are relative to the root.
    return Answer(resources=listed, base="" if address == "rw" else address)


def _below(routes: tuple[Route, ...], parts: list[str]) -> Iterator[str]:
    """Yield the names of readable resources below an address that is no resource itself."""
    for route in routes:
        if (
            route.method == "GET"
            and len(route.parts) > len(parts)
            and list(route.parts[: len(parts)]) == parts
        ):
            name = route.parts[len(parts)]
            if not name.startswith(("{", "$")):
                yield name
