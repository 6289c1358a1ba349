MODULE Right
  ! The right arm grips the part that the left one holds, and takes it back a little.

  TASK PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0.01]];
  CONST robtarget pMiddle:=[[775,0,700],[0,-0.707106781,0,0.707106781],
    [0,0,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfL\Off;
    MoveJ Offs(pMiddle,120,0,0), v1000, fine, tGrip;
    WaitDO doBrought, 1;
    MoveL pMiddle, v500, fine, tGrip;
    SetDO doRight, 1;
    WaitDO doLetGo, 1;
    MoveL Offs(pMiddle,120,0,0), v500, fine, tGrip;
  ENDPROC
ENDMODULE
