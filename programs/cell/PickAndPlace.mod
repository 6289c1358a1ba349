MODULE PickAndPlace
  ! Parts come on a conveyor, a gripper takes them, a press gets them.
  ! What conveyor, gripper and press do is in rapidsim.toml beside this file.
  !
  !   rapidsim run programs/cell

  TASK PERS tooldata tGrip:=[TRUE,[[0,0,150],[1,0,0,0]],[3,[0,0,70],[1,0,0,0],0,0,0.01]];
  TASK PERS wobjdata wConveyor:=[FALSE,TRUE,"",[[550,-350,250],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  TASK PERS wobjdata wPress:=[FALSE,TRUE,"",[[550,400,350],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pWait:=[[0,0,220],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPick:=[[0,0,0],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pBefore:=[[0,0,180],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlace:=[[0,0,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ pWait, v1000, fine, tGrip\WObj:=wConveyor;
    FOR part FROM 1 TO 2 DO
      pick;
      place;
      TPWrite "Parts: "\Num:=part;
    ENDFOR
    MoveJ pWait, v1000, fine, tGrip\WObj:=wConveyor;
  ENDPROC

  PROC pick()
    MoveJ Offs(pPick,0,0,120), v1000, z50, tGrip\WObj:=wConveyor;
    WaitDI diPart, 1;
    MoveL pPick, v200, fine, tGrip\WObj:=wConveyor;
    SetDO doGrip, 1;
    WaitDI diGripped, 1;
    MoveL Offs(pPick,0,0,120), v500, z50, tGrip\WObj:=wConveyor;
  ENDPROC

  PROC place()
    MoveJ pBefore, v1000, z50, tGrip\WObj:=wPress;
    WaitDI diPressOpen, 1;
    MoveL pPlace, v200, fine, tGrip\WObj:=wPress;
    SetDO doGrip, 0;
    WaitDI diGripped, 0;
    MoveL pBefore, v500, fine, tGrip\WObj:=wPress;
    PulseDO\PLength:=0.3, doPress;
  ENDPROC
ENDMODULE
