MODULE example
  PROC main()
    IF TRUE THEN ! found
      WaitTime 1;
    ENDIF
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR num n;
  PROC main()
    IF TRUE THEN                      ! found
      WaitTime 1;
    ELSEIF 1>2 THEN                   ! found
      WaitTime 2;
    ENDIF
    IF NOT (TRUE) WaitTime 1;         ! found
    WHILE FALSE DO                    ! found
      Incr n;
    ENDWHILE
  ENDPROC
ENDMODULE
