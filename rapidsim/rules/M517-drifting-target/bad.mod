MODULE example
  PERS robtarget p_pick:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    FOR i FROM 1 TO 3 DO
      MoveJ p_pick,v500,fine,tool0;
      p_pick:=Offs(p_pick,50,0,0); ! found
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE bad
  PERS robtarget p_pick:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p_pick,v500,fine,tool0;
    p_pick:=RelTool(Offs(p_pick,50,0,0),0,0,-1); ! found
  ENDPROC
ENDMODULE
