MODULE example
  PERS robtarget p_pick:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    FOR i FROM 0 TO 2 DO
      MoveJ Offs(p_pick,50*i,0,0),v500,fine,tool0;
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST robtarget p_first:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS robtarget p_next:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS robtarget p_other:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget p_now;
  PROC main()
    p_next:=p_first;
    p_now:=p_first;
    p_other:=Offs(p_first,0,0,50);
    FOR i FROM 1 TO 3 DO
      MoveJ p_next,v500,fine,tool0;
      p_next:=Offs(p_next,50,0,0);
      p_now:=Offs(p_now,50,0,0);
    ENDFOR
  ENDPROC
ENDMODULE
