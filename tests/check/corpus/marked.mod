MODULE marked
  ! with a byte order mark: ü
  PROC main()
    WaitTime 1;
  ENDPROC
ENDMODULE
