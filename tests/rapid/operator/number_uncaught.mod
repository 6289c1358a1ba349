! RAPID Instructions, TPReadNum: a time-out that nobody handles stops the program.
MODULE number_uncaught
  VAR num count;

  PROC main()
    TPReadNum count,"How many?"\MaxTime:=3;
    ! -> How many?
    ! stops: TPReadNum: no answer within 3 s (ERR_TP_MAXTIME)
  ENDPROC
ENDMODULE
