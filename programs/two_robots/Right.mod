MODULE Right
  TASK PERS tooldata tGrip:=[TRUE,[[0,0,150],[1,0,0,0]],[3,[0,0,70],[1,0,0,0],0,0,0.01]];
  TASK PERS wobjdata wTable:=[FALSE,TRUE,"",[[800,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pMiddle:=[[0,0,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pBox:=[[-250,400,100],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ\Off;
    ConfL\Off;
    FOR part FROM 1 TO 2 DO
      MoveJ Offs(pBox,0,0,150), v1000, fine, tGrip\WObj:=wTable;
      WaitDO doPartInMiddle, 1;
      MoveJ Offs(pMiddle,0,0,150), v1000, z50, tGrip\WObj:=wTable;
      MoveL pMiddle, v300, fine, tGrip\WObj:=wTable;
      MoveL Offs(pMiddle,0,0,150), v500, z50, tGrip\WObj:=wTable;
      MoveJ Offs(pBox,0,0,150), v1000, fine, tGrip\WObj:=wTable;
      SetDO doPartInMiddle, 0;
      MoveL pBox, v300, fine, tGrip\WObj:=wTable;
      TPWrite "Parts in the box: "\Num:=part;
    ENDFOR
  ENDPROC
ENDMODULE
