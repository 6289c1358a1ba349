MODULE example
  CONST robtarget far:=[[700,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget near:=[[560,-140,480],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    ConfJ \Off;
    MoveJ far,v500,fine,tool0;
    MoveJ near,v500,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE not_called
  CONST robtarget near:=[[500,-140,480],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    TPWrite "not yet";
  ENDPROC
  PROC later()
    MoveAbsJ [[23,16,18,0,56,23],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    ConfJ \Off;
    MoveJ near,v500,fine,tool0;
  ENDPROC
ENDMODULE
