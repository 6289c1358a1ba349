! Field practice, Labels: on lines of their own, to leave loops and to try again.
MODULE jumps
  VAR num tries;

  PROC main()
    start:
    tries:=tries+1;
    FOR row FROM 1 TO 3 DO
      FOR column FROM 1 TO 3 DO
        IF row*column=4 GOTO found;
      ENDFOR
    ENDFOR
    found:
    IF tries<2 THEN
      GOTO start;
    ENDIF
    TPWrite "tries: "\Num:=tries;         ! -> tries: 2
  ENDPROC
ENDMODULE
