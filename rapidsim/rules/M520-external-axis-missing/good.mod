! ---
MODULE near_miss
  CONST jointtarget p:=[[0,0,0,0,30,0],[1500,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget q:=[[0,0,0,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ p,v500,fine,tool0;
    DeactUnit TRACK;
    MoveAbsJ q,v500,fine,tool0;
  ENDPROC
ENDMODULE
