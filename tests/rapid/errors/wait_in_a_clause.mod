! RAPID Overview, Error recovery: time passes in a clause as it does anywhere.
MODULE wait_in_a_clause
  VAR num zero;
  VAR clock watch;

  PROC main()
    ClkStart watch;
    zero:=1/zero;
    TPWrite "after "\Num:=ClkRead(watch);        ! -> after 1.5
  ERROR
    WaitTime 1.5;
    TRYNEXT;
  ENDPROC
ENDMODULE
