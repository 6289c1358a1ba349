MODULE example
  PROC main()
    VAR num x;
    WHILE x<0.25 DO
      x:=x+0.1;
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PROC main()
    VAR num x:=0.5;
    VAR dnum d:=2;
    IF x=0.5 OR x<>-0.25 OR x=3 OR x=1E6 WaitTime 1;
    IF x<0.3 OR x>=0.1 WaitTime 1;
    IF "0.3"="0.3" AND d=16777217 WaitTime 1;
  ENDPROC
ENDMODULE
