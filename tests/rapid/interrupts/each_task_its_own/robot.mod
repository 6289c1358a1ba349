! RAPID Instructions, IDisable: each task has its own interrupts, and holds up none but its own.
MODULE robot
  VAR intnum called;
  VAR num calls;
  PERS bool told:=FALSE;

  PROC main()
    CONNECT called WITH come;
    ISignalDO doCall,1,called;
    WaitUntil told\MaxTime:=10;
    TPWrite "calls "\Num:=calls;             ! -> calls 2
  ENDPROC

  TRAP come
    Incr calls;
  ENDTRAP
ENDMODULE
