! RAPID Instructions, RaiseToUser: an error leaves NOSTEPIN routines for the user's ERROR clause.
MODULE raise_to_user
  PROC main()
    process;
    TPWrite "next";                     ! -> next
  ERROR
    TPWrite "user has "\Num:=ERRNO;     ! -> user has 40
    TRYNEXT;
  ENDPROC
ENDMODULE

MODULE raise_to_user_hidden(NOSTEPIN)
  PROC process()
    part;
    TPWrite "never";
  ERROR
    TPWrite "never, it is hidden";
    TRYNEXT;
  ENDPROC

  PROC part()
    RAISE 30;
  ERROR
    TPWrite "seen "\Num:=ERRNO;         ! -> seen 30
    RaiseToUser \BreakOff \ErrorNumber:=40;
  ENDPROC
ENDMODULE
