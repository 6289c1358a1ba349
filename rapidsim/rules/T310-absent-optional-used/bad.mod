MODULE example
  PROC main()
    wait_a_little;
  ENDPROC
  PROC wait_a_little(\num seconds)
    WaitTime seconds; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  PROC main()
    wait_a_little;
    either\b:=2;
  ENDPROC
  PROC wait_a_little(\num seconds\num others)
    IF Present(others) WaitTime 1;
    WaitTime seconds;                 ! found
    WaitTime seconds+1;
  ENDPROC
  PROC either(\num a|num b)
    WaitTime a;                       ! found
    WaitTime b;
  ENDPROC
ENDMODULE
