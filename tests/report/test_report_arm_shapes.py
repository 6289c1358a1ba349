"""What a page draws an arm from: links that give the arm's own kinematics, bodies, limits."""

from typing import Any

import numpy as np
import pytest

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.report.html.arm_shapes import arm_data

ARMS = ["irb1600", "irb120", "kr10", "rvm1", "irb6640", "irb2400-10-1.55", "irb910sc", "irb920t"]


def drawn_flange(data: Any, joints_deg: Array) -> tuple[Array, Array]:
    """Turn and place [mm] of the flange as the page computes them."""
    turn, place = np.eye(3), np.zeros(3)
    for link in data["links"]:
        slid = joints_deg @ np.array(link["slide"]) if "slide" in link else np.zeros(3)
        place = place + turn @ (np.array(link["place"]) + slid)
        angle = np.radians(np.array(link["shares"]) @ joints_deg)
        own = rotation_from_vector(np.array(link["axis"]) * angle)
        turn = turn @ np.array(link["turn"]).reshape(3, 3) @ own
    return turn, place


@pytest.mark.parametrize("name", ARMS)
def test_the_page_moves_the_arm_as_its_kinematics_do(name: str) -> None:
    robot = load_robot(name)
    data: Any = arm_data(robot)
    random = np.random.default_rng(7)
    for _ in range(5):
        joints = random.uniform(-1.0, 1.0, len(robot.joints))
        turn, place = drawn_flange(data, np.degrees(joints))
        flange = robot.forward(joints)
        assert turn == pytest.approx(flange.rotation, abs=1e-6)
        assert place == pytest.approx(1000.0 * flange.translation, abs=0.01)
    lower = [low for low, _ in data["limits"]]
    assert lower == pytest.approx(np.degrees(robot.lower).tolist(), abs=0.001)


def test_a_slider_tells_the_unit_of_its_joint() -> None:
    data: Any = arm_data(load_robot("irb910sc"))
    assert data["units"] == ["°", "°", " mm", "°"]
    assert data["limits"][2] == [-180.0, 0.0]
    assert [link.get("slide") for link in data["links"]] == [
        *(None, None),
        [[0.0] * 3, [0.0] * 3, [0.0, 0.0, 1.0], [0.0] * 3],  # 1 mm a mm
        *(None, None),
    ]


def test_bodies_are_as_large_as_the_arm() -> None:
    data: Any = arm_data(load_robot("irb120"))
    assert {body["link"] for body in data["bodies"]} >= {0, 1, 2, 3, 4}
    base = [np.array(body["corners"]).reshape(-1, 3) for body in data["bodies"] if not body["link"]]
    corners = np.concatenate(base)
    # The foot of an IRB 120 is 180 mm wide, and it stands on the ground.
    assert np.ptp(corners[:, 1]) == pytest.approx(180.0, abs=15.0)
    assert corners[:, 2].min() == pytest.approx(0.0, abs=2.0)
    assert all(len(body["colour"]) == 7 for body in data["bodies"])


def test_an_arm_whose_links_do_not_turn_alone_is_left_to_its_poses() -> None:
    assert arm_data(load_robot("irb460")) is None


def test_a_users_arm_has_links_and_no_bodies() -> None:
    plain = load_robot("irb120")
    own: Robot = Robot(**{
        field: getattr(plain, field) for field in plain.__dataclass_fields__
    } | {"urdf": None})  # fmt: skip
    data: Any = arm_data(own)
    assert data["bodies"] == []
    assert len(data["links"]) == 7
