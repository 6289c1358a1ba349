MODULE example
  CONST speeddata v120:=[120,500,5000,1000];
  PROC main()
    WaitTime v120.v_tcp/1000;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  ! v120 and z7 are not predefined; low and edge are names like any other in a routine.
  CONST speeddata v120:=[120,500,5000,1000];
  CONST zonedata z7:=[FALSE,7,10,10,1,10,1];
  PROC main()
    VAR num low:=1;
    VAR num edge:=2;
    WaitTime (low+edge)/v120.v_tcp;
    WaitTime z7.pzone_tcp/100;
  ENDPROC
ENDMODULE
