MODULE example
  PROC main()
    stack 3;
  ENDPROC
  PROC stack(num layers)
    FOR layer FROM 1 TO layers DO
      WaitTime 0.1;
    ENDFOR
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PROC main()
    first;
    second;
    first;
  ENDPROC
  PROC first()
    second;
  ENDPROC
  PROC second()
    WaitTime 1;
  ENDPROC
ENDMODULE
