! RAPID Instructions, StopMove: \Quick stops on the path as fast as possible, without it later.
MODULE stop_quickly
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum pause;
  VAR bool in_a_hurry:=TRUE;
  VAR num way{2};

  PROC main()
    CONNECT pause WITH on_pause;
    FOR i FROM 1 TO 2 DO
      MoveJ p1,v500,fine,tool0;
      ITimer\Single,0.5,pause;
      MoveL p2,v100,fine,tool0;
      in_a_hurry:=FALSE;
    ENDFOR
    TPWrite "shorter "\Bool:=way{1}<0.3*way{2};        ! -> shorter TRUE
    TPWrite "on the path "\Bool:=way{2}<50;            ! -> on the path TRUE
  ENDPROC

  TRAP on_pause
    VAR pos began;
    VAR pos stands;
    began:=CPos(\Tool:=tool0);
    IF in_a_hurry THEN
      StopMove\Quick;
    ELSE
      StopMove;
    ENDIF
    stands:=CPos(\Tool:=tool0);
    IF in_a_hurry way{1}:=Distance(began,stands);
    IF NOT in_a_hurry way{2}:=Distance(began,stands);
    StartMove;
  ENDTRAP
ENDMODULE
