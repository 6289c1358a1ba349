! RAPID Overview, CONTINUE: a loop in an ERROR clause has turns like any other.
MODULE continue_in_a_handler
  VAR num none;

  PROC main()
    TPWrite ValToStr(1/none);               ! -> 1
  ERROR
    FOR i FROM 1 TO 3 DO
      IF i<>2 CONTINUE;
      TPWrite ValToStr(i);                  ! -> 2
    ENDFOR
    none:=1;
    RETRY;
  ENDPROC
ENDMODULE
