! RAPID Instructions, TPReadNum: who answers at once is not timed out, and the flag is 0.
MODULE answered_in_time
  PROC main()
    VAR num n;
    VAR errnum broke:=9;
    VAR clock watch;
    ClkStart watch;
    TPReadNum n,"How many?"\MaxTime:=3\BreakFlag:=broke; ! -> How many? 12
    TPWrite ValToStr(broke);                ! -> 0
    TPReadFK n,"Which?","a","b",stEmpty,stEmpty,stEmpty\MaxTime:=3; ! -> Which? b
    TPWrite ValToStr(n);                    ! -> 2
    TPReadNum n,"More?"\MaxTime:=3\BreakFlag:=broke; ! -> More?
    TPWrite ValToStr(ClkRead(watch));       ! -> 3
  ENDPROC
ENDMODULE
