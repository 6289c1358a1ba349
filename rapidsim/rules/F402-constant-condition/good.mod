MODULE example
  PERS bool slow:=FALSE;
  PROC main()
    IF slow THEN
      WaitTime 1;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST bool with_gripper:=FALSE;
  CONST num layers:=3;
  PERS bool go_on:=TRUE;
  PROC main()
    WHILE TRUE DO
      IF with_gripper OR layers=3 WaitTime 1;
      IF go_on<>TRUE RETURN;
    ENDWHILE
  ENDPROC
ENDMODULE
