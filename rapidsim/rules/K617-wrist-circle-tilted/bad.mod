MODULE example
  CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ RelTool(p,0,0,0\Ry:=15),v500,fine,tool0;
    CirPathMode \Wrist45;
    MoveC Offs(p,0.2,0.2,0),Offs(p,0.4,0,0),v20,fine,tool0; ! found
  ENDPROC
ENDMODULE
! ---
MODULE hole
  ! The tool leans by 20 degrees.
  CONST robtarget rim:=[[850,50,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ RelTool(rim,0,0,0\Ry:=20),v500,fine,tool0;
    CirPathMode \Wrist45;
    MoveC Offs(rim,0.2,0.2,0),Offs(rim,0.4,0,0),v20,fine,tool0; ! found
  ENDPROC
ENDMODULE
