MODULE needs_neighbours
  CONST robtarget pG:=[[500,0,300],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    InitProgram;
    Gripper_Open 2\slow;
    rOpenDoor;
    MoveJ pG,v500,z10,tool0;
    WHILE TestDI(diReady)=FALSE DO
      WaitTime 0.1;
    ENDWHILE
    TPWrite "part"\Num:=GetPart(3);
    Logging "part";
  ENDPROC
ENDMODULE
