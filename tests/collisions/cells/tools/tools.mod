MODULE tools
  ! As in shop.mod: cells that are as they should be, and others with one fault.
  PERS tooldata tLeft:=[TRUE,[[0,-90,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS tooldata tRight:=[TRUE,[[0,90,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS tooldata tSucker:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  VAR robtarget last;

  PROC go(PERS tooldata tool,num x,num y,num z)
    ConfJ\Off;
    ConfL\Off;
    last:=[[x,y,z],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    MoveJ Offs(last,0,0,150),v1500,z10,tool;
    MoveL last,v1000,fine,tool;
  ENDPROC

  PROC up(PERS tooldata tool)
    MoveL Offs(last,0,0,150),v1000,fine,tool;
  ENDPROC

  PROC good_two_grippers()
    go tLeft,600,-100,480;
    SetDO doLeft,1;
    up tLeft;
    go tRight,600,100,480;
    SetDO doRight,1;
    up tRight;
    go tRight,450,600,482;
    up tRight;
    go tLeft,600,100,480;
    SetDO doLeft,0;
    up tLeft;
    go tRight,600,-100,480;
    SetDO doRight,0;
    up tRight;
  ENDPROC

  PROC wrong_tool()
    go tRight,600,-100,480;
    SetDO doLeft,1; ! fault
    up tRight;
  ENDPROC

  PROC second_in_gripper()
    go tRight,600,100,480;
    SetDO doRight,1;
    up tRight;
    WaitTime 0.1;
    SetDO doBoth,1; ! fault
    WaitTime 0.1;
  ENDPROC

  PROC good_tool_change()
    go tool0,450,600,520;
    SetDO doLock,1;
    up tool0;
    go tSucker,600,-100,480;
    SetDO doSuck,1;
    up tSucker;
    go tSucker,600,0,480;
    SetDO doSuck,0;
    up tSucker;
    go tool0,450,600,520;
    SetDO doLock,0;
    up tool0;
  ENDPROC

  PROC without_the_tool()
    go tSucker,600,-100,480;
    SetDO doSuck,1; ! fault
    up tSucker;
  ENDPROC
ENDMODULE
