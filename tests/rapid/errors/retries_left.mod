! RAPID Functions, RemainingRetries: four are left at first, one less after each RETRY.
MODULE retries_left
  VAR num zero;

  PROC main()
    zero:=1/zero;
    TPWrite "next";                     ! -> next
  ERROR
    TPWrite "left "\Num:=RemainingRetries();
    ! -> left 4
    ! -> left 3
    ! -> left 2
    ! -> left 1
    ! -> left 0
    IF RemainingRetries()>0 RETRY;
    TRYNEXT;
  ENDPROC
ENDMODULE
