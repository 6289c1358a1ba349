! RAPID Kernel, Error recovery: the caller's RETRY calls the routine that failed again.
MODULE retry_calls_again
  VAR num attempts;

  PROC main()
    pick;
    TPWrite "picked";                   ! -> picked
  ERROR
    TPWrite "again";                    ! -> again
    RETRY;
  ENDPROC

  PROC pick()
    attempts:=attempts+1;
    TPWrite "attempt "\Num:=attempts;
    ! -> attempt 1
    ! -> attempt 2
    IF attempts<2 RAISE 10;
  ENDPROC
ENDMODULE
