! RAPID Instructions, RaiseToUser: without \ErrorNumber the user gets the number there was.
MODULE raise_to_user_same_number
  VAR num zero;

  PROC main()
    process;
    TPWrite "next";                     ! -> next
  ERROR
    IF ERRNO=ERR_DIVZERO TPWrite "division by zero";        ! -> division by zero
    TRYNEXT;
  ENDPROC
ENDMODULE

MODULE raise_to_user_number_kept(NOSTEPIN)
  PROC process()
    VAR num nought;
    nought:=1/nought;
  ERROR
    RaiseToUser \BreakOff;
  ENDPROC
ENDMODULE
