MODULE example
  VAR num serial_number;
  PROC main()
    serial_number:=16777217; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  VAR num serial:=16777217;           ! found
  PROC main()
    serial:=123456789;                ! found
    IF serial>33554433 WaitTime 1;    ! found
  ENDPROC
ENDMODULE
