MODULE example
  PROC main()
    ! WaitTime 5; ! found
    WaitTime 1;
  ENDPROC
ENDMODULE
