"""Answers have the statuses, codes, keys, places of lists, bases and types that were recorded.

The recordings, refusals of RobotWare 6.16 and 7.21, bodies of 7.21 and of 6.16, results of a real
IRC5, are published with clients of Robot Web Services; only their shapes are here.
"""

from __future__ import annotations

import json
import re
from base64 import b64encode
from pathlib import Path
from typing import Any, NamedTuple

import aiohttp
from served_controller import Served, serve

from rapidsim.server.versions import served_versions

CELL = {
    "RAPID/TASK1/PROGMOD/MainModule.mod": "MODULE MainModule\n  PERS num k := 0;\n  PROC main()\n"
    "    WaitTime 9;\n  ENDPROC\nENDMODULE\n",
    "RAPID/TASK1/SYSMOD/BASE.sys": "MODULE BASE(SYSMODULE,NOSTEPIN)\nENDMODULE\n",
    "SYSPAR/EIO.cfg": """EIO:CFG_1.0:6:1::
#
INDUSTRIAL_NETWORK:

      -Name "Net"
#
NET_DEVICE:

      -Name "Dev" -Address "12"
#
EIO_SIGNAL:

      -Name "doGripper" -SignalType "DO" -Device "Dev" -Access "All"

      -Name "ES1" -SignalType "DO" -Device "Dev" -Access "ReadOnly"

      -Name "TEST_DO_RWS" -SignalType "DO" -Access "All"
""",
}
JSON, XHTML = "application/json", "application/xhtml+xml"
HAL, XHTML_2 = "application/hal+json;v=2.0", "application/xhtml+xml;v=2.0"
FORM_2 = "application/x-www-form-urlencoded;v=2.0"
START = "regain=continue&execmode=continue&cycle=forever&condition=none&alltaskbytsp=false"
JOG = "jog-data=0,0,0,0,0,0&ccount=1&inc-mode=Small&token=1"


class Refused(NamedTuple):
    """A recorded refusal."""

    method: str
    path: str
    status: int
    code: int
    body: str = ""
    held: bool = False
    """Whether another session holds the mastership."""


FIRST = (
    Refused(
        "POST", "rw/cfg/EIO/EIO_SIGNAL/instances/ES1?action=set", 400, -1073445879, "Access=All"
    ),
    Refused("POST", "rw/motionsystem/mechunits/ROB_1?action=jog", 400, -1073445879, JOG),
    Refused("POST", "rw/rapid/tasks/T_ROB1?action=loadmod", 400, -1073438708),
    Refused("POST", "rw/rapid/tasks/T_ROB1?action=unloadmod", 400, -1073442816, "module=No"),
    Refused("POST", "rw/mastership/rapid?action=request", 403, -1073445862, held=True),
    Refused("POST", "rw/iosystem/signals/ES1?action=set", 403, -1073445881, "lvalue=1"),
    Refused("GET", "rw/rapid/tasks/T_ROB1/modules/NoSuchModule", 404, -1073414146),
    Refused("GET", "rw/iosystem/signals/NoSuchNet/NoSuchDev/NoSuchSig", 404, -1073445866),
    Refused("GET", "rw/rapid/symbol/data/RAPID/T_ROB1/NoMod/noSym", 400, -1073414146),
    Refused("GET", "rw/rapid/uiinstr/active", 404, -1073414146),
    # In this state of the table's last row, programs execute.
    Refused("POST", "rw/rapid/execution?action=start", 400, -1073442809, START),
)
SECOND = (
    Refused("GET", "fileservice/NOVOL:/NO_SUCH", 400, -1073438716),
    Refused("GET", "rw/rapid/tasks/T_ROB1/modules/NoSuchModule", 400, -1073442813),
    Refused("GET", "rw/rapid/tasks/NO_SUCH_TASK/modules", 404, -1073445879),
    Refused("POST", "rw/rapid/execution/start", 403, -1073445862, START, held=True),
    Refused("POST", "rw/mastership/edit/request", 403, -1073445862, held=True),
    Refused("POST", "rw/iosystem/signals/Net/Dev/ES1/set-value", 403, -1073445881, "lvalue=1"),
    Refused("POST", "rw/panel/speedratio?action=setspeedratio", 403, -1073445859, "speed-ratio=9"),
    Refused("GET", "uas/ldap/enabled", 403, -1073445867),
    Refused("GET", "rw/iosystem/signals/NoSuchNet/NoSuchDev/NoSuchSig", 404, -1073445866),
    Refused("GET", "rw/rapid/symbol/RAPID/T_ROB1/BASE/no_such_var/data", 404, -1073442816),
)

TEXT = "text"
SIGNAL = {"name": TEXT, "type": TEXT, "category": TEXT, "lvalue": TEXT, "lstate": TEXT}
DONE = {"code": 294912}


def _itself(href: str) -> dict[str, Any]:
    return {"_links": {"self": {"href": href}}}


def _links(base: str, itself: str = "") -> dict[str, Any]:
    return {"base": {"href": f"ROOT{base}"}, "self": {"href": itself}}


def _signal(title: str) -> dict[str, Any]:
    return {
        **_itself(f"signals/{title}"),
        "_type": "ios-signal-li",
        "_title": title,
        **SIGNAL,
    }


def _listed(path: str, kind: str, *titles: str) -> dict[str, Any]:
    """A list of resources whose items have other fields than were recorded."""
    items = [{**_itself(one), "_type": kind, "_title": one} for one in titles]
    return {"_links": _links(f"{path}/"), "_embedded": {"resources": items}}


NOWHERE = "ROOTrw/retcode?code=-1073414145"
BODIES: dict[str, dict[str, Any]] = {
    "rw/panel/ctrl-state": {
        "_links": _links("rw/panel/ctrl-state/"),
        "status": DONE,
        "state": [{"_type": "pnl-ctrlstate", "_title": "ctrl-state", "ctrlstate": TEXT}],
    },
    "rw/rapid/tasks": {
        "_links": _links("rw/rapid/", "tasks"),
        "_embedded": {
            "resources": [
                {**_itself("tasks/spy"), "_type": "rap-tasks-spy-li", "_title": "spy"},
                {
                    **_itself("tasks/T_ROB1"),
                    "_type": "rap-task-li",
                    "_title": "T_ROB1",
                    **dict.fromkeys(
                        ("name", "type", "taskstate", "excstate", "active", "motiontask"), TEXT
                    ),
                },
            ]
        },
    },
    "rw/rapid/tasks/T_ROB1/modules": {
        "_links": _links("rw/rapid/", "tasks/T_ROB1/modules"),
        "status": DONE,
        "state": [
            {"_type": "rap-module-info-li", "_title": f"T_ROB1/{one}", "name": TEXT, "type": TEXT}
            for one in ("BASE", "MainModule")
        ],
    },
    "rw/motionsystem/mechunits/ROB_1/jointtarget": {
        "_links": _links("rw/motionsystem/mechunits/ROB_1/jointtarget/"),
        "status": DONE,
        "state": [
            {
                "_type": "ms-jointtarget",
                "_title": "ROB_1",
                **{f"rax_{number}": TEXT for number in range(1, 7)},
                **{f"eax_{letter}": "0" for letter in "abcdef"},
            }
        ],
    },
    "rw/motionsystem/mechunits/ROB_1/cartesian": {
        "_links": _links("rw/motionsystem/mechunits/ROB_1/cartesian/"),
        "status": DONE,
        "state": [
            {
                "_type": "ms-mechunit-cartesian",
                "_title": "ROB_1",
                **dict.fromkeys(("x", "y", "z", "q1", "q2", "q3", "q4"), TEXT),
                **dict.fromkeys(("cf1", "cf4", "cf6", "cfx"), TEXT),
            }
        ],
    },
    "rw/iosystem/signals?start=0&limit=2": {
        "_links": {
            **_links("rw/iosystem/", "signals?start=0&amp;limit=2"),
            "next": {"href": "signals?start=2&amp;limit=2"},
        },
        "_embedded": {"resources": [_signal("Net/Dev/doGripper"), _signal("Net/Dev/ES1")]},
    },
    "rw/elog/0?lang=en": {
        "_links": _links("rw/elog/", "0?lang=en"),
        "_embedded": {
            "resources": [
                {
                    **_itself("0/1?lang=en"),
                    "_type": "elog-message-li",
                    "_title": "/rw/elog/0/1",
                    **dict.fromkeys(("msgtype", "code"), TEXT),
                    "tstamp": "9999-99-99 T 99:99:99",
                    **dict.fromkeys(("title", "desc", "conseqs", "causes", "actions"), TEXT),
                    "argc": TEXT,
                }
            ]
        },
    },
    "rw/system": {
        "_links": _links("rw/system/"),
        "state": [
            {
                "_type": "sys-system",
                "_title": "system",
                **dict.fromkeys(("major", "minor", "name", "rwversion", "sysid"), TEXT),
                "starttm": "9999-99-99 T 99:99:99",
            }
        ],
        "_embedded": {
            "resources": [
                {
                    **_itself("options"),
                    "_type": "sys-options-li",
                    "_title": "options",
                    "options": [{"_type": "sys-options", "_title": "0", "option": TEXT}],
                }
            ]
        },
    },
    "fileservice": _listed("fileservice", "fs-dir", "HOME", "TEMP", "RAMDISK", "BACKUP"),
    "rw/cfg/EIO/EIO_SIGNAL/instances/ES1": {
        "_links": _links("rw/cfg/", "EIO/EIO_SIGNAL/instances/ES1"),
        "_embedded": {
            "resources": [
                {
                    **_itself("EIO/EIO_SIGNAL/instances/ES1"),
                    "_type": "cfg-dt-instance-li",
                    "_title": "ES1",
                    "rdonly": TEXT,
                    "attrib": [
                        {"_type": "cfg-ia-t", "_title": one, "value": TEXT}
                        for one in ("Name", "SignalType", "Device", "Access")
                    ],
                }
            ]
        },
    },
}
"""Bodies of RobotWare 7."""
POINTERS = {
    "_links": _links("rw/rapid/", "tasks/T_ROB1/pcp"),
    "status": DONE,
    "state": [
        {"_type": "pcp-info", "_title": one, one: {"_links": {"error": {"href": NOWHERE}}}}
        for one in ("progpointer", "motionpointer")
    ],
}
"""Pointers of RobotWare 8.2.1 that are nowhere."""
PAGES = {
    # Addresses in the list of services are relative to the root.
    "rw": ("", "rw/panel"),
    "rw/devices": ("rw/devices/", "HW_DEVICES"),
    "rw/iosystem/signals": ("rw/iosystem/", "signals/Net/Dev/doGripper"),
    "rw/iosystem/networks": ("rw/iosystem/", "networks/Net"),
    "rw/iosystem/devices": ("rw/iosystem/", "devices/Net/Dev"),
    "rw/elog/0?lang=en": ("rw/elog/", "0/1?lang=en"),
    "fileservice/$HOME": ("fileservice/%24HOME/", "user.sys"),
}
"""Bases of RobotWare 6, and an address that is relative to each."""


def _shape(body: Any, root: str) -> Any:
    """A body whose texts are replaced by what they are, but for addresses, classes and titles."""
    if isinstance(body, list):
        return [_shape(one, root) for one in body]
    if not isinstance(body, dict):
        return body
    shown = {}
    for key, value in body.items():
        if key in ("_type", "_title") or key.startswith("eax") or not isinstance(value, str):
            shown[key] = _shape(value, root)
        elif key == "href":
            shown[key] = value.replace(root, "ROOT")
        else:
            stamp = re.sub(r"\d", "9", value)
            shown[key] = stamp if stamp.startswith("9999-") else TEXT
    return shown


async def _refusal(
    served: Served, client: aiohttp.ClientSession, row: Refused, content: str, base: str
) -> None:
    """Send a request that is refused, in one representation."""
    url = f"{base}/{row.path}"
    headers = {"Accept": content}
    if content == JSON:
        url += "&json=1" if "?" in url else "?json=1"
    if row.method != "GET":
        plain = "application/x-www-form-urlencoded"
        headers["Content-Type"] = FORM_2 if "v=2.0" in content else plain
    body = row.body.encode()
    async with client.request(row.method, url, data=body, headers=headers) as answer:
        text = await answer.text()
        found = (answer.status, answer.headers["Content-Type"], str(row.code) in text)
        # The root stands alone: nothing is relative to a refused address.
        has_root = f'"{base}/"' in text
        assert (*found, has_root) == (row.status, content, True, True), (row, text)
        if "json" in content:
            shown = json.loads(re.sub(r'"msg": "[^"]*"', '"msg": ""', text))
            status: dict[str, object] = {"status": {"code": row.code, "msg": ""}}
            inside = status if content == HAL else {"_embedded": {**status, "_state": []}}
            assert shown == {"_links": {"base": {"href": f"{base}/"}}, **inside}


def test_recorded_answers(tmp_path: Path) -> None:
    for name, text in CELL.items():
        (tmp_path / "cell" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "cell" / name).write_text(text)
    (tmp_path / "home").mkdir()
    (tmp_path / "home" / "user.sys").write_text("")
    login = {"Authorization": "Basic " + b64encode(b"Admin:robotics").decode()}

    async def use(served: Served) -> None:
        other = await served.second_client()
        for action in ("start", "stop"):  # Which the event log has.
            await other.post(f"rw/rapid/execution?action={action}")
        jar = aiohttp.CookieJar(unsafe=True)
        async with aiohttp.ClientSession(headers=login, cookie_jar=jar) as second:
            await _bodies(served, second)
            for row in SECOND:
                if row.held:
                    assert (await other.post("rw/mastership?action=request"))[0] == 204
                for content in (HAL, XHTML_2):
                    await _refusal(served, second, row, content, served.second)
                await other.post("rw/mastership?action=release")
            missing = f"{served.second}/fileservice/HOME/no-such-file-xyz.modx"
            async with second.get(missing, headers={"Accept": HAL}) as answer:
                status = (await answer.json(content_type=None))["status"]
                shown = answer.status, answer.headers["Content-Type"], status["code"]
                assert shown == (404, "text/html", -1073438713)
            await _pointers(served, second)
        await _pages(served)
        await other.post("rw/rapid/execution?action=start", cycle="forever")
        for row in FIRST:
            if row.path == FIRST[2].path:
                # What is loaded or unloaded waits for programs to stop.
                await other.post("rw/rapid/execution?action=stop")
            if row is FIRST[-1]:
                await other.post("rw/rapid/execution?action=start", cycle="forever")
            if row.held:
                assert (await other.post("rw/mastership?action=request"))[0] == 204
            for content in (JSON, XHTML):
                await _refusal(served, served.client, row, content, served.base)
            await other.post("rw/mastership?action=release")
        # Refusals of files are XHTML, whatever was asked for.
        none = Refused("GET", "fileservice/$HOME/no-such-file-xyz.mod?json=1", 404, -1073414146)
        await _refusal(served, served.client, none, XHTML, served.base)
        await other.client.close()

    serve(tmp_path, None, use)


async def _bodies(served: Served, client: aiohttp.ClientSession) -> None:
    for path, expected in BODIES.items():
        async with client.get(f"{served.second}/{path}", headers={"Accept": HAL}) as answer:
            assert (answer.status, answer.headers["Content-Type"]) == (200, HAL)
            body = _shape(await answer.json(content_type=None), f"{served.second}/")
        if "state" in body:
            body["state"].sort(key=lambda one: one["_title"])
        if path == "rw/system":
            # Links to what else is there follow.
            del body["_embedded"]["resources"][1:]
        if path.startswith("rw/elog"):
            # The oldest entry comes first.
            del body["_embedded"]["resources"][1:]
        assert body == expected, path
        assert list(body) == list(expected), path


async def _pointers(served: Served, client: aiohttp.ClientSession) -> None:
    """Read the pointers as RobotWare 8 has them, and as 7 had them."""
    url = f"{served.second}/rw/rapid/tasks/T_ROB1/pcp"
    task = served.engine.live.task("T_ROB1")
    versions = served.engine.context.versions
    shown = []
    for version, has_pointer in ((8, False), (8, True), (7, True), (7, False)):
        served.engine.context.versions = served_versions(None, version)
        task.has_pointer = has_pointer
        async with client.get(url, headers={"Accept": HAL}) as answer:
            shown.append(_shape(await answer.json(content_type=None), f"{served.second}/"))
    task.has_pointer, served.engine.context.versions = True, versions
    names = ("modulemame", "routinename", "beginposition", "endposition", "executiontype")
    fields = dict.fromkeys(names, TEXT)
    nested, flat = shown[1]["state"][0], shown[2]["state"]
    assert shown[0] == POINTERS
    assert nested == {"_type": "pcp-info", "_title": "progpointer", "progpointer": fields}
    assert flat == [{"_type": "pcp-info", "_title": "progpointer", **fields}]
    assert shown[3]["state"] == []


async def _pages(served: Served) -> None:
    for path, (base, href) in PAGES.items():
        async with served.client.get(f"{served.base}/{path}") as answer:
            text = await answer.text()
        assert f'<base href="{served.base}/{base}"/>' in text, path
        assert f'<a href="{href}" rel="self"/>' in text, path
    async with served.client.get(f"{served.base}/rw/iosystem/signals?json=1") as answer:
        body = await answer.json()
    # Numbers are no texts in lists of JSON, and addresses lead to JSON.
    body["_embedded"]["_state"] = body["_embedded"]["_state"][1:2]
    title = "Net/Dev/ES1"
    assert body == {
        "_links": {"base": {"href": f"{served.base}/rw/iosystem/"}},
        "_embedded": {
            "_state": [
                {
                    "_links": {"self": {"href": f"signals/{title}?json=1"}},
                    "_type": "ios-signal-li",
                    "_title": title,
                    **{"name": "ES1", "type": "DO", "category": ""},
                    **{"lvalue": 0, "lstate": "not simulated"},
                }
            ]
        },
    }
    (system, options) = await served.get("rw/system")
    assert (system["_type"], options["_type"]) == ("sys-system-li", "sys-options-li")
    assert options["options"][0]["_type"] == "sys-option-li"
    assert system.keys() >= {"name", "rwversion", "sysid", "starttm", "rwversionname"}
    (arm,) = await served.get("rw/system/robottype")
    (unit,) = await served.get("rw/motionsystem/mechunits")
    assert (arm["_title"], arm["robot-type"]) == ("1", "IRB 1600-6/1.2")
    assert (unit["mode"], unit["activation-allowed"]) == ("Activated", "True")
    for path, kind, names in (
        ("rw/system/robottype", "sys-robottype", {"robot-type"}),
        ("rw/system/license", "sys-license", {"license"}),
        ("rw/retcode?code=-1073445859", "err-desc", {"name", "code", "severity", "description"}),
        ("rw/rapid/tasks/T_ROB1/motion", "rap-motion", {"mechunit"}),
        ("rw/rapid/tasks/T_ROB1/motion?resource=jointtarget", "ms-jointtarget", {"rax_1"}),
        ("rw/rapid/tasks/T_ROB1/motion?resource=robtarget", "ms-robtargets", {"q1"}),
        ("rw/motionsystem/mechunits/ROB_1/cartesian", "ms-mechunit-cartesian", {"q1", "j1", "jx"}),
        ("rw/elog/0/1", "elog-message", {"code", "title"}),
        ("rw/rapid/tasks/spy", "rap-spy-status", {"status"}),
        ("rw/rapid/modules/BASE?task=T_ROB1", "rap-module", {"modname", "filename", "attribute"}),
        ("ctrl/backup?action=backupstate", "ctrl-backup-state", {"backup state"}),
        ("ctrl/identity", "ctrl-identity-info", {"ctrl-name", "ctrl-type", "ctrl-level"}),
    ):
        (item,) = await served.get(path)
        assert item["_type"] == kind
        assert item.keys() >= names
    (system_module,) = await served.get("rw/rapid/modules/base?task=T_ROB1")
    assert tuple(
        system_module[one] for one in ("taskname", "modname", "filename", "attribute")
    ) == (*("T_ROB1", "BASE", "BASE.sys", "sysmod,nostepin"),)
    axes = await served.get("rw/motionsystem/mechunits/ROB_1/axes")
    assert (axes[0]["_type"], axes[0]["axes"], len(axes)) == ("ms-mechunit-axes", "6", 7)
    axis = await served.get("rw/motionsystem/mechunits/ROB_1/axes/6")
    assert [(one["_type"], *list(one.items())[2:]) for one in axis] == [
        ("ms-mechunit-axisstatus", ("axis-status", "Synchronized")),
        ("ms-mechunit-logicalaxis", ("logical-axis", "6")),
    ]
    assert await served.status("rw/motionsystem/mechunits/ROB_1/axes/7") == (404, -1073414146)
    # Counts of entries only where they are asked for.
    assert "numevts" not in (await served.get("rw/elog"))[0]
    assert (await served.get("rw/elog?resource=count"))[0]["numevts"] != "0"
    names = {one["name"] for one in await served.get("rw/retcode")}
    assert {"SYS_CTRL_E_EXEC_STATE", "SYS_CTRL_E_INVALIDARG", "SYS_CTRL_E_RESOURCE_HELD"} <= names
    for path, kind in (("", "srvlst-service-li"), ("rw", "rwservice-li")):
        services = {one["_title"]: one for one in await served.get(path)}
        assert {one["_type"] for one in services.values()} == {kind}
        assert services.keys() > ({"rapid", "retcode"} if path else {"rw", "ctrl"})
    assert {one["_type"] for one in await served.get("rw/panel")} == {
        f"pnl-{one}-li" for one in ("ctrlstate", "opmode", "speedratio", "coldetstate")
    }
    modules = await served.get("rw/rapid/modules?task=T_ROB1")
    kinds = {one["name"]: one["type"] for one in modules}
    assert kinds == {"BASE": "SysMod", "MainModule": "ProgMod"}
    (groups,) = await served.get("rw/devices")
    assert [one["_title"] for one in groups["devices"]] == ["HW_DEVICES", "SW_RESOURCES"]
    (units,) = await served.get("rw/devices/HW_DEVICES")
    assert {one["_type"] for one in units["devices"]} == {"dev-id-li"}
    assert [one["_title"] for one in units["devices"]] == ["CONTROLLER", "ROB_1"]
    assert [one["name"] for one in await served.get("rw/iosystem/networks")] == ["Local", "Net"]
    states = []
    for fails in (True, False):
        await (served.fail(kind="device_lost", device="Dev") if fails else served.mend())
        states.append((await served.get("rw/iosystem/devices?network=net"))[0])
    assert await served.get("rw/iosystem/devices?network=none") == []
    served.engine.live.cell.disabled_devices.add("dev")
    states.append((await served.get("rw/iosystem/devices"))[0])
    assert [(one["name"], one["lstate"], one["pstate"]) for one in states] == [
        ("Dev", "enabled", "error"),
        ("Dev", "enabled", "running"),
        ("Dev", "disabled", "stopped"),
    ]
    disks = {one["_title"]: one for one in await served.get("fileservice")}
    assert disks["$RAMDISK"]["fs-device-type"] == "ramdisk"
    url = f"{served.base}/rw/iosystem/signals?action=signal-search"
    async with served.client.post(url, data={"name": "TEST_DO"}) as answer:
        text = await answer.text()
    assert f'<base href="{served.base}/rw/iosystem/"/>' in text
    assert 'href="signals/TEST_DO_RWS"' in text
