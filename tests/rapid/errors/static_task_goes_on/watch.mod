! RAPID Overview, Multitasking: main of a static task begins anew, and its data keep their values.
MODULE watch
  PERS num turns;
  VAR num own;
  VAR num zero;

  PROC main()
    Incr turns;
    Incr own;
    IF own=2 zero:=1/zero;
    IF own=3 ErrWrite\W,"Low","Air";         ! -> warning Low: Air
    WaitTime 0.5;
  ERROR
    TPWrite "handled";                       ! -> handled
    TRYNEXT;
  ENDPROC
ENDMODULE
