"""Kinematics as clients request them: ABB's own example, poses and joints there and back."""

from __future__ import annotations

import json
from base64 import b64encode
from pathlib import Path
from typing import Any

import aiohttp
import numpy as np
import pytest
from served_controller import Served, serve

IDLE = "MODULE Idle\nPROC main()\nWaitTime 1;\nENDPROC\nENDMODULE\n"
UNIT = "rw/motionsystem/mechunits/ROB_1"
JOINTS = [-0.0554263890, 0.0185516607, 0.151851505, 2.56702399, 0.540392220, 0.813871026]
"""[rad], of the example in ABB's reference of Robot Web Services, an IRB 140."""
PLACE = (0.511087716, -0.0101547204, 0.665710211)
"""[m], the flange there."""
TOOL = {"tool_frame_position": "[0,0,0]", "tool_frame_orientation": "[1.0,0,0,0]"}
LATER = {
    "CalcPoseFromJoints": "pose-from-joints",
    "JointsFromCartesian": "joints-from-cartesian",
    "AllJointSolutions": "all-joints-solution",
}
LOGIN = {"Authorization": "Basic " + b64encode(b"Admin:robotics").decode()}
HAL = {
    "Accept": "application/hal+json;v=2.0",
    "Content-Type": "application/x-www-form-urlencoded;v=2.0",
}


class Asks:
    """Requests of calculations, in both generations, whose answers must be alike."""

    def __init__(self, served: Served, later: aiohttp.ClientSession) -> None:
        self.served, self.later = served, later

    async def ask(self, action: str, **form: str) -> list[dict[str, Any]]:
        """The items of an answer."""
        url = f"{self.served.base}/{UNIT}?action={action}&json=1"
        async with self.served.client.post(url, data=form) as answer:
            assert answer.status == 200, await answer.text()
            items: list[dict[str, Any]] = (await answer.json())["_embedded"]["_state"]
        url = f"{self.served.second}/{UNIT}/{LATER[action]}"
        body = aiohttp.FormData(form)()
        async with self.later.post(url, data=body, headers=HAL) as answer:
            assert (await answer.json(content_type=None))["state"] == items
        return items

    async def pose(self, joints: list[float], tool: dict[str, str]) -> dict[str, Any]:
        """The pose of a tool at joints."""
        (item,) = await self.ask("CalcPoseFromJoints", rob_joints=json.dumps(joints), **tool)
        return item


def numbers(item: dict[str, Any], prefix: str, names: str | tuple[str, ...]) -> list[float]:
    return [float(item[f"{prefix}{name}"]) for name in names]


def test_poses_and_joints_are_calculated(tmp_path: Path) -> None:
    (tmp_path / "cell").mkdir()
    (tmp_path / "cell" / "Idle.mod").write_text(IDLE)
    (tmp_path / "cell" / "rapidsim.toml").write_text('[robot]\nmodel = "irb140-6-0.81"\n')

    async def use(served: Served) -> None:
        jar = aiohttp.CookieJar(unsafe=True)
        async with aiohttp.ClientSession(headers=LOGIN, cookie_jar=jar) as later:
            await _there_and_back(Asks(served, later))
        await _refused(served)

    serve(tmp_path, None, use)


async def _there_and_back(asks: Asks) -> None:
    quarters = ("j1", "j4", "j6", "jx")
    flange = await asks.pose(JOINTS, TOOL)
    assert (flange["_type"], flange["_title"]) == ("position-from-joint", "positionData")
    assert numbers(flange, "position-", "xyz") == pytest.approx(PLACE, abs=1e-7)
    tool = {"tool_frame_position": "[0.1,0,0.2]", "tool_frame_orientation": "[0.5,0.5,-0.5,0.5]"}
    pose = await asks.pose(JOINTS, tool)
    assert numbers(pose, "quarter-rev-", quarters) == [-1, 1, 0, 0]
    offset = np.subtract(numbers(pose, "position-", "xyz"), PLACE)
    assert np.linalg.norm(offset) == pytest.approx(np.hypot(0.1, 0.2), abs=1e-7)
    form = {
        "curr_position": json.dumps(numbers(pose, "position-", "xyz")),
        "curr_orientation": json.dumps(numbers(pose, "robtargetorientation-u", "0123")),
        "robot_configuration": "[-1,1,0,0]",
        **tool,
    }
    (found,) = await asks.ask("JointsFromCartesian", **form)
    assert found["_type"] == "joints-from-cartesian"
    assert numbers(found, "robotjoint", "123456") == pytest.approx(JOINTS, abs=1e-6)
    solutions = await asks.ask("AllJointSolutions", **form)
    names = ("j11", *quarters[1:])
    assert [-1, 1, 0, 0] in [numbers(one, "quarter_rev_", names) for one in solutions]
    for one in solutions:
        assert one["_type"] == "all-joint-solutions"
        again = await asks.pose(numbers(one, "robotjoint", "123456"), tool)
        for part, axes in (("position-", "xyz"), ("robtargetorientation-u", "0123")):
            expected = numbers(pose, part, axes)
            assert numbers(again, part, axes) == pytest.approx(expected, abs=1e-6)
        assert numbers(again, "quarter-rev-", quarters) == numbers(one, "quarter_rev_", names)


async def _refused(served: Served) -> None:
    pose = {"curr_position": "[0.5,0,0.6]", "curr_orientation": "[1,0,0,0]", **TOOL}
    far = {**pose, "curr_position": "[5,0,0.6]", "robot_configuration": "[0,0,0,0]"}
    for action, form in (
        ("CalcPoseFromJoints", TOOL),
        ("CalcPoseFromJoints", {"rob_joints": "[1,2,3]", **TOOL}),
        ("CalcPoseFromJoints", {"rob_joints": "[1,2,3,4,5,true]", **TOOL}),
        ("CalcPoseFromJoints", {"rob_joints": "[1,2,3,4,5,NaN]", **TOOL}),
        ("CalcPoseFromJoints", {"rob_joints": "[" * 5000, **TOOL}),
        ("CalcPoseFromJoints", {"rob_joints": str(JOINTS), **TOOL, "robot_fixed_object": "TRUE"}),
        ("AllJointSolutions", far),
        ("AllJointSolutions", {**pose, "curr_orientation": "[0,0,0,0]"}),
        ("JointsFromCartesian", far),
        ("JointsFromCartesian", pose),
    ):
        url = f"{served.base}/{UNIT}?action={action}&json=1"
        async with served.client.post(url, data=form) as answer:
            status = (await answer.json())["_embedded"]["status"]
            assert (answer.status, status["code"]) == (400, -1073445879), (action, form)
