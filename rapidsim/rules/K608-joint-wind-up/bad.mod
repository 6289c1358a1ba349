MODULE example
  CONST robtarget p:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
    ConfL\Off;
    WHILE TRUE DO
      MoveL p,v500,fine,tool0; ! found
      MoveL RelTool(p,0,0,-50\Rz:=120),v20,fine,tool0;
      MoveL RelTool(p,0,0,-80\Rz:=240),v20,fine,tool0;
    ENDWHILE
  ENDPROC
ENDMODULE
