! RAPID Overview, CONTINUE: it ends the turn of the innermost loop, out of jumps, too.
MODULE continue_in_loops
  PROC main()
    VAR num tries;
    FOR i FROM 1 TO 2 DO
      FOR j FROM 1 TO 3 DO
        IF j=i CONTINUE;
        TPWrite ValToStr(10*i+j);           ! -> 12 ! -> 13 ! -> 21 ! -> 23
      ENDFOR
    ENDFOR
    FOR i FROM 1 TO 3 DO
      tries:=0;
      again:
      tries:=tries+1;
      IF tries=1 GOTO again;
      IF i=2 CONTINUE;
      TPWrite ValToStr(i);                  ! -> 1 ! -> 3
    ENDFOR
  ENDPROC
ENDMODULE
