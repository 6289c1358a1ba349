MODULE example
  PROC main()
    VAR num x;
    WHILE NOT x=0.3 DO ! found
      x:=x+0.1;
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE bad
  PROC main()
    VAR num x;
    IF x=0.3 OR x=1 WaitTime 1;       ! found
    IF -0.7<>x WaitTime 1;            ! found
    x:=x+0.1;
    IF (x>1)=(x=2.2) WaitTime 1;      ! found
  ENDPROC
ENDMODULE
