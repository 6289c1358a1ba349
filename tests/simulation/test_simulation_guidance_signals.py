"""Programs whose robot signals guide instead of a sensor: EGMSetupAO, EGMSetupAI."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from simulation_program import ran
from simulation_sensor import end_s, joints_at
from test_simulation_guidance import HEAD

from rapidsim.controller.cell.description import CellIo, SignalDeclaration, SignalKind, Stimulus

SIGNALS = CellIo(
    signals=(
        SignalDeclaration("aoFirst", SignalKind.AO),
        SignalDeclaration("giSecond", SignalKind.GI, highest=4095.0),
        SignalDeclaration("aiX", SignalKind.AI),
        SignalDeclaration("aiRz", SignalKind.AI),
    )
)


def test_outputs_guide_joints() -> None:
    # Axis 1 follows the output; the others have no signal and stay.
    body = r"""    MoveAbsJ home, v1000, fine, tool0;
    EGMGetId id;
    EGMSetupAO ROB_1, id, "default" \Joint \aoR1x:=aoFirst;
    EGMActJoint id \J1:=[-0.01,0.01] \LpFilter:=100 \MaxSpeedDeviation:=90;
    SetAO aoFirst, 12;
    EGMRunJoint id, EGM_STOP_HOLD \J1 \CondTime:=0.1 \RampInTime:=0;
    EGMReset id;"""
    text = HEAD + f"  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n"
    it = ran(text, io=SIGNALS)
    assert it.end == "ended"
    assert np.allclose(joints_at(it, end_s(it)), (12, 0, 0, 0, 30, 0), atol=0.01)


def test_inputs_guide_poses() -> None:
    # The TCP goes to x = 700 mm in the world; what has no signal stays.
    stimulus = Stimulus(values={"aiX": 700.0}, at_s=0.0)
    body = r"""    VAR robtarget before;
    VAR robtarget after;
    VAR pose none := [[0,0,0],[1,0,0,0]];
    MoveAbsJ home, v1000, fine, tool0;
    before := CRobT(\Tool:=tool0 \WObj:=wobj0);
    EGMGetId id;
    EGMSetupAI ROB_1, id, "default" \Pose \aiR1x:=aiX;
    EGMActPose id, none, EGM_FRAME_WORLD, none, EGM_FRAME_WORLD \x:=[-0.01,0.01] \LpFilter:=100
      \MaxSpeedDeviation:=90;
    EGMRunPose id, EGM_STOP_HOLD \x \CondTime:=0.1 \RampInTime:=0;
    after := CRobT(\Tool:=tool0 \WObj:=wobj0);
    TPWrite ValToStr(Round(after.trans.x \Dec:=1));
    TPWrite ValToStr(Round(after.trans.z - before.trans.z \Dec:=1));"""
    text = HEAD + f"  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n"
    it = ran(text, io=replace(SIGNALS, stimuli=(stimulus,)))
    assert it.texts == ["700", "0"]


def test_inputs_turn_the_tool() -> None:
    # About the axes of the world; without a signal the angle is 0.
    stimulus = Stimulus(values={"aiX": 10.0}, at_s=0.0)
    body = r"""    VAR pose none := [[0,0,0],[1,0,0,0]];
    VAR robtarget after;
    MoveAbsJ home, v1000, fine, tool0;
    EGMGetId id;
    EGMSetupAI ROB_1, id, "default" \Pose \aiR6rz:=aiX;
    EGMActPose id, none, EGM_FRAME_WORLD, none, EGM_FRAME_WORLD \rx:=[-0.01,0.01]
      \ry:=[-0.01,0.01] \rz:=[-0.01,0.01] \LpFilter:=100 \MaxSpeedDeviation:=90;
    EGMRunPose id, EGM_STOP_HOLD \rx \ry \rz \CondTime:=0.1 \RampInTime:=0;
    after := CRobT(\Tool:=tool0 \WObj:=wobj0);
    TPWrite ValToStr(Round(EulerZYX(\Z, after.rot) \Dec:=1));
    TPWrite ValToStr(Round(EulerZYX(\Y, after.rot) \Dec:=1));
    TPWrite ValToStr(Round(EulerZYX(\X, after.rot) \Dec:=1));"""
    text = HEAD + f"  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n"
    it = ran(text, io=replace(SIGNALS, stimuli=(stimulus,)))
    assert it.texts == ["10", "0", "0"]
