MODULE example
  VAR num parts:=0;
  PROC main()
    WaitTime 10/parts;
  ERROR RETRY; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR num parts:=0;
  PROC main()
    WaitTime 10/parts;
  ERROR
    TPWrite "again";
    RETRY;                            ! found
  ENDPROC
  FUNC num share()
    RETURN 10/parts;
  ERROR
    RETRY;                            ! found
  ENDFUNC
ENDMODULE
