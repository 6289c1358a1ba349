! RAPID Instructions, CallByVar: calls the global procedure whose name ends in a number.
MODULE call_by_variable
  VAR num n:=1;

  PROC main()
    CallByVar "job",n;
    CallByVar "JOB",n+1;
    CallByVar "job",n/2;
    CallByVar "job",-1;
    CallByVar "job",3;
    CallByVar "job",4;                      ! stops: no procedure is named ":job4" (ERR_REFUNKPRC)
  ERROR
    IF ERRNO=ERR_ARGVALERR THEN
      TPWrite "no such number";
      ! -> no such number
      ! -> no such number
      TRYNEXT;
    ENDIF
    RAISE;
  ENDPROC

  PROC job1()
    TPWrite "one";                          ! -> one
  ENDPROC

  PROC job2()
    TPWrite "two";                          ! -> two
  ENDPROC

  PROC job3()
    n:=1/0;
    TPWrite "three";                        ! -> three
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
