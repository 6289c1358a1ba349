MODULE example
  VAR dnum serial_number;
  PROC main()
    serial_number:=16777217;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num n:=16777216;
  CONST num unused_axis:=9E9;
  VAR dnum d:=16777217;
  PROC main()
    n:=8388608;
    n:=unused_axis;
    n:=100000000;
    d:=d+4294967295;
    WaitTime n*0;
  ENDPROC
ENDMODULE
