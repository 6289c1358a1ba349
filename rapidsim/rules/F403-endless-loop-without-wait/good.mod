MODULE example
  VAR num count;
  PROC main()
    WHILE TRUE DO
      count:=count+1;
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num count;
  VAR bool done;
  PROC main()
    WHILE TRUE DO
      count:=count+1;
      IF count>3 THEN
        done:=TRUE;
        count_on;
      ENDIF
    ENDWHILE
  ENDPROC
  PROC count_on()
    WHILE NOT done DO
      count:=count-1;
    ENDWHILE
    WHILE TRUE DO
      Incr count;
      IF count>9 RETURN;
    ENDWHILE
  ENDPROC
ENDMODULE
! ---
MODULE jumps
  VAR num count;
  PROC main()
    again:
    Incr count;
    WaitTime 0.1;
    GOTO again;
  ENDPROC
  PROC other()
    again:
    Incr count;
    IF count<3 GOTO again;
    IF count<5 THEN
      GOTO again;
    ENDIF
    GOTO last;
    last:
  ENDPROC
ENDMODULE
