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
  ! Nobody but this module sees it.
  LOCAL CONST num pi:=3.14159;
  ! Controllers without an option do not have its names.
  VAR errnum ERR_HAND_FAILEDGRIP:=54;
  ! A program books this number itself.
  VAR errnum ERR_GLUEFLOW:=-1;
  PROC restart()
    BookErrNo ERR_GLUEFLOW;
    RAISE ERR_HAND_FAILEDGRIP;
  ENDPROC
  PROC main()
    VAR num low:=1;
    VAR num edge:=2;
    ! Type is a function, which is not used here.
    VAR num type:=3;
    WaitTime (low+edge+type*pi)/v120.v_tcp;
    WaitTime z7.pzone_tcp/100;
    restart;
  ENDPROC
ENDMODULE
