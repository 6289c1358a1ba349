MODULE example
  CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
    CirPathMode \Wrist56;
    MoveC Offs(p,1,1,0),Offs(p,2,0,0),v20,fine,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE slot
  ! Axis 6 cannot move a tool that is in line with it.
  CONST robtarget rim:=[[850,50,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ rim,v500,fine,tool0;
    CirPathMode \Wrist46;
    MoveC Offs(rim,1,1,0),Offs(rim,2,0,0),v20,fine,tool0; ! found
  ENDPROC
ENDMODULE
