MODULE Unload
  ! Takes the finished part out of the vice from the other side, and says when it is out of the way.
  ! Load.mod and Eager.mod run with it.

  TASK PERS tooldata tGrip:=[TRUE,[[0,0,160],[1,0,0,0]],[2,[0,0,80],[1,0,0,0],0,0,0.01]];
  TASK PERS wobjdata wVice:=[FALSE,TRUE,"",[[950,0,420],[0,0,0,1]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pVice:=[[0,0,150],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pOut:=[[-350,0,350],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    WaitTime 2; ! the machine is still at work
    MoveJ pOut, v1000, z20, tGrip\WObj:=wVice;
    MoveL Offs(pVice,0,0,120), v500, z5, tGrip\WObj:=wVice;
    MoveL pVice, v100, fine, tGrip\WObj:=wVice;
    SetDO doTake, 1;
    WaitTime 0.3;
    MoveL Offs(pVice,0,0,120), v200, z5, tGrip\WObj:=wVice;
    MoveL pOut, v1000, fine, tGrip\WObj:=wVice;
    SetDO doViceFree, 1;
  ENDPROC
ENDMODULE
