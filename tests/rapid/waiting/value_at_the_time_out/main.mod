! RAPID Instructions, WaitAI: \ValueAtTimeout says what the input was when the time was over.
MODULE value_at_the_time_out
  VAR num value;
  VAR dnum bits;

  PROC main()
    WaitAI aiOne\GT,5\MaxTime:=0.5\ValueAtTimeout:=value;
    WaitGI giOne,3\MaxTime:=0.5\DvalueAtTimeout:=bits;
  ERROR
    TPWrite ValToStr(value)+" "+ValToStr(bits);    ! -> 2.5 0 ! -> 2.5 7
    TRYNEXT;
  ENDPROC
ENDMODULE
