MODULE Out_of_reach
  ! A plate is trimmed along its edge. The fixture stands too far away: one corner cannot be reached,
  ! which the program deals with, and the way back leads through the arm itself, which it does not.
  !
  !   rapidsim run programs/out_of_reach.mod

  TASK PERS wobjdata wPlate:=[FALSE,TRUE,"",[[600,0,700],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  CONST robtarget pFront:=[[0,-200,0],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pSide:=[[0,300,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pFar:=[[900,200,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pHome:=[[-1200,250,0],[0,0,1,0],[1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ pFront, v500, fine, tool0\WObj:=wPlate;
    MoveL pSide, v200, fine, tool0\WObj:=wPlate;
    trim;
    MoveL pFront, v200, fine, tool0\WObj:=wPlate;
    MoveL pHome, v500, fine, tool0\WObj:=wPlate;
  ENDPROC

  PROC trim()
    MoveL pFar, v300, fine, tool0\WObj:=wPlate;
  ERROR
    TPWrite "The far corner is left out";
    TRYNEXT;
  ENDPROC
ENDMODULE
