! RAPID Instructions, WaitDI to WaitGO: each wait for a signal ends with \MaxTime.
MODULE time_out_of_all_waits
  VAR num late;
  VAR clock watch;

  PROC main()
    ClkStart watch;
    WaitDI diOne,1\MaxTime:=0.5;
    WaitDO doOne,1\MaxTime:=0.5;
    WaitAI aiOne\GT,5\MaxTime:=0.5;
    WaitAO aoOne\LT,-5\MaxTime:=0.5;
    WaitGI giOne,3\MaxTime:=0.5;
    WaitGO goOne\NOTEQ,0\MaxTime:=0.5;
    TPWrite ValToStr(late)+" of 6 after "+ValToStr(ClkRead(watch));    ! -> 6 of 6 after 3
  ERROR
    IF ERRNO=ERR_WAIT_MAXTIME THEN
      Incr late;
      TRYNEXT;
    ENDIF
  ENDPROC
ENDMODULE
