MODULE pick_and_place
  ! A gripper that needs 0.4 s to close and 0.3 s to open, and says when it has. The program waits for
  ! both, so the robot leaves the part 0.4 s after doGrip and the place 0.3 s after it is reset. Two
  ! moves of 100 mm at 200 mm/s, half a second each, end before the gripper is told anything.
  CONST robtarget pick:=[[800,-200,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget place:=[[800,200,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ Offs(pick,0,0,100),v1000,z10,tool0;
    MoveL pick,v200,fine,tool0;
    Set doGrip;
    WaitDI diGripped,1 \MaxTime:=2;
    MoveL Offs(pick,0,0,100),v500,z10,tool0;
    MoveJ Offs(place,0,0,100),v1000,z10,tool0;
    MoveL place,v200,fine,tool0;
    Reset doGrip;
    WaitDI diGripped,0 \MaxTime:=2;
    PulseDO \PLength:=0.5,doPlaced;
    MoveL Offs(place,0,0,100),v500,fine,tool0;
  ENDPROC
ENDMODULE
