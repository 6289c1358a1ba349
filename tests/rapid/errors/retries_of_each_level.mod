! RAPID Overview, Error recovery: a routine that an ERROR clause calls may handle errors of its own;
! the retries of the statement that the clause answers go on being counted.
MODULE retries_of_each_level
  VAR num zero;
  VAR num inner;

  PROC main()
    zero:=1/zero;
    TPWrite "next";                     ! -> next
  ERROR
    cleanUp;
    TPWrite "left "\Num:=RemainingRetries();
    ! -> left 4
    ! -> left 3
    ! -> left 2
    ! -> left 1
    ! -> left 0
    IF RemainingRetries()>0 RETRY;
    TRYNEXT;
  ENDPROC

  PROC cleanUp()
    inner:=0;
    zero:=2/zero;
  ERROR
    Incr inner;
    IF inner<3 RETRY;
    TRYNEXT;
  ENDPROC
ENDMODULE
