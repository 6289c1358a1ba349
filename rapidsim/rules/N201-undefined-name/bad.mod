MODULE example
  VAR num parts:=3;
  PROC main()
    prats:=parts+1; ! found
  ENDPROC
ENDMODULE
! ---
MODULE example
  PROC main()
    IF prats=[1,2,3] THEN ! found
    ENDIF
  ENDPROC
ENDMODULE
