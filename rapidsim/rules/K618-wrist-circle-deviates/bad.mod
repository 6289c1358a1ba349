MODULE example
  CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
    CirPathMode \Wrist45;
    MoveC Offs(p,4,4,0),Offs(p,8,0,0),v20,fine,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE wide_hole
  ! So wide a hole turns the tool by more than half a degree.
  CONST robtarget rim:=[[850,50,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ rim,v500,fine,tool0;
    CirPathMode \Wrist45;
    MoveC Offs(rim,3,3,0),Offs(rim,6,0,0),v20,fine,tool0; ! found
  ENDPROC
ENDMODULE
