MODULE example
  CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
    CirPathMode \Wrist45;
    MoveC Offs(p,0.2,0.2,0),Offs(p,0.4,0,0),v20,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE slot
  ! Axes 4 and 5 can tilt the tool so far.
  CONST robtarget rim:=[[850,50,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ rim,v500,fine,tool0;
    CirPathMode \Wrist45;
    MoveC Offs(rim,0.2,0.2,0),Offs(rim,0.4,0,0),v20,fine,tool0;
  ENDPROC
ENDMODULE
