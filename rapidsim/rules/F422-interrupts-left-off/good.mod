MODULE example
  VAR num count;
  PROC main()
    count_part 1;
  ENDPROC
  PROC count_part(num n)
    IF n=0 RETURN;
    IDisable;
    count:=count+n;
    IEnable;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  VAR num count;
  PROC main()
    lock;
    count:=count+1;
    unlock;
    IDisable;
    leave;
    IDisable;
    IF count>3 ExitCycle;
    IEnable;
  ENDPROC
  PROC lock()
    IDisable;
  ENDPROC
  PROC unlock()
    IEnable;
  ENDPROC
  PROC leave()
    count:=0;
    unlock;
  ENDPROC
ENDMODULE
! ---
MODULE server
  VAR num count;
  PROC main()
    IDisable;
    serve;
  ENDPROC
  PROC serve()
    WHILE TRUE DO
      count:=count+1;
      WaitTime 1;
    ENDWHILE
  ENDPROC
  PROC unlock()
    IEnable;
  ENDPROC
ENDMODULE
