"""Random motion programs: most of their moves can be made, and many nearly cannot."""

from __future__ import annotations

import random
from functools import cache

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.robot.robot import Robot, load_robot

ROBOTS = ("irb1600", "irb120", "irb4600-40-2.55", "irb140", "irb6640-180-2.55")
_NO_AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
_ZONES = ("fine", "fine", "z1", "z10", "z50")
_TOOLS = ("tool0", "tGrip", "tTorch")
_WOBJS = ("wobj0", "wTable")
_DATA = """  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS tooldata tTorch:=[TRUE,[[30,0,90],[0.9238795,0,0.3826834,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[150,-80,40],[0.9659258,0,0,0.258819]],[[0,0,0],[1,0,0,0]]];
"""


@cache
def robot_of(name: str) -> Robot:
    return load_robot(name)


def robot_name(seed: int) -> str:
    """The arm of a program."""
    return ROBOTS[seed % len(ROBOTS)]


def _frames(names: tuple[str, ...]) -> dict[str, Transform]:
    values = {
        "tool0": ((0, 0, 0), (1, 0, 0, 0)),
        "tGrip": ((0, 0, 120), (1, 0, 0, 0)),
        "tTorch": ((30, 0, 90), (0.9238795, 0, 0.3826834, 0)),
        "wobj0": ((0, 0, 0), (1, 0, 0, 0)),
        "wTable": ((150, -80, 40), (0.9659258, 0, 0, 0.258819)),
    }
    return {
        name: Transform.from_quaternion(
            np.array([values[name][1]], dtype=float), np.array([values[name][0]]) * 1e-3
        )[0]
        for name in names
    }


class Programs:
    """Writes one program."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.robot = robot_of(robot_name(seed))
        self.tool = self.random.choice(_TOOLS)
        self.wobj = self.random.choice(_WOBJS)
        self.data: list[str] = []
        self.body: list[str] = []
        self.joints = self._anywhere()

    def text(self) -> str:
        """The program."""
        say = self.random
        if say.random() < 0.5:
            self.body.append(say.choice((r"ConfJ\Off;", r"ConfL\Off;", r"ConfJ\Off; ConfL\Off;")))
        if say.random() < 0.05:
            self.body.append("here:=CRobT();")
        for _ in range(say.randint(1, 7)):
            self._statement()
        body = "\n".join(f"    {line}" for line in self.body)
        data = "\n".join(f"  {line}" for line in self.data)
        return (
            f"MODULE cell\n{_DATA}  VAR robtarget here;\n  VAR num n;\n{data}\n"
            f"  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n"
        )

    def _statement(self) -> None:
        say = self.random
        drawn = say.random()
        if drawn < 0.1:
            self.body.append(say.choice((r"ConfL\Off;", r"ConfL\On;", r"ConfJ\Off;", r"ConfJ\On;")))
        elif drawn < 0.14:
            self.body.append(say.choice((r"SingArea\Wrist;", r"SingArea\Off;")))
        if drawn > 0.96:
            self.tool, self.wobj = say.choice(_TOOLS), say.choice(_WOBJS)
        if say.random() < 0.15:
            self._move_axes()
            return
        self.joints = self._next()
        kind = say.choice(("MoveJ", "MoveJ", "MoveL", "MoveL", "MoveL", "MoveC"))
        to = self._target(self.joints)
        if kind == "MoveC":
            middle = to
            self.joints = self._nearby(0.15)
            to = self._target(self.joints)
            self._add(f"MoveC {middle},{to}")
            return
        if say.random() < 0.2:
            x, y, z = (say.choice((0, 10, -25, 60, 150)) for _ in range(3))
            call = say.choice(("Offs", "Offs", "RelTool"))
            to = f"{call}({to},{x},{y},{z})"
        if say.random() < 0.08:
            self.body.append("FOR i FROM 0 TO 2 DO")
            self._add(f"{kind} Offs({to},0,40*i,20*i)")
            self.body.append("ENDFOR")
            return
        self._add(f"{kind} {to}")

    def _add(self, move: str) -> None:
        say = self.random
        speed, zone = say.choice(("v100", "v500", "v1000")), say.choice(_ZONES)
        self.body.append(rf"{move},{speed},{zone},{self.tool}\WObj:={self.wobj};")

    def _move_axes(self) -> None:
        self.joints = self._next()
        if self.random.random() < 0.15:
            axis = self.random.randrange(6)
            self.joints[axis] = self.robot.upper[axis] + np.radians(self.random.choice((0.03, 4.0)))
        axes = ",".join(f"{value:.3f}" for value in np.degrees(self.joints))
        zone = self.random.choice(_ZONES)
        self.body.append(f"MoveAbsJ [[{axes}],{_NO_AXES}],v500,{zone},{self.tool};")

    def _anywhere(self) -> Array:
        lower, upper = (np.clip(x, -3.0, 3.0) for x in (self.robot.lower, self.robot.upper))
        shares = np.array([self.random.uniform(0.1, 0.9) for _ in lower])
        joints: Array = lower + shares * (upper - lower)
        return joints

    def _nearby(self, far: float) -> Array:
        step = np.array([self.random.uniform(-far, far) for _ in self.joints])
        joints: Array = np.clip(self.joints + step, self.robot.lower, self.robot.upper)
        return joints

    def _next(self) -> Array:
        drawn = self.random.random()
        if drawn < 0.15:
            return self._anywhere()
        joints = self._nearby(0.35)
        if drawn < 0.25:
            axis = self.random.randrange(6)
            limit = self.random.choice((self.robot.lower, self.robot.upper))[axis]
            joints[axis] = limit + np.radians(self.random.choice((-0.5, -0.04, 0.0, 0.04, 0.3)))
        elif drawn < 0.3:
            joints[4] = np.radians(self.random.choice((0.0, 0.002, -0.002, 0.5)))
        return joints

    def _target(self, joints: Array) -> str:
        say, frames = self.random, _frames((self.tool, self.wobj))
        base_from_tcp = self.robot.forward(joints) @ frames[self.tool]
        pose = frames[self.wobj].inverse() @ base_from_tcp
        position, quaternion = pose.translation * 1e3, pose.quaternion
        conf = confdata_of(self.robot.kinematics, joints).tolist()
        drawn = say.random()
        if drawn < 0.2:
            conf[say.randrange(3)] += say.choice((-1, 1))
        elif drawn < 0.26:
            conf[say.randrange(3)] += say.choice((-4, -3, -2, 2, 3, 4))
        elif drawn < 0.3:
            conf[3] = say.randrange(8)
        elif drawn < 0.32:
            position = position * say.choice((1.02, 1.2, 2.0))
        x, y, z = (f"{value:.2f}" for value in position)
        rot = ",".join(f"{value:.6f}" for value in quaternion)
        if say.random() < 0.006:
            rot = "0,0,0,0"
        written = f"[[{x},{y},{z}],[{rot}],{str(conf).replace(' ', '')},{_NO_AXES}]"
        if say.random() < 0.25:
            return written
        name = f"p{len(self.data)}"
        self.data.append(f"{say.choice(('CONST', 'CONST', 'VAR'))} robtarget {name}:={written};")
        return name


def random_program(seed: int) -> str:
    """A program for the arm `robot_name(seed)`."""
    return Programs(seed).text()
