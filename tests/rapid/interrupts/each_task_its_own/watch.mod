! RAPID Instructions, IDisable: what came meanwhile is served after IEnable.
MODULE watch
  VAR intnum called;
  PERS bool told;

  PROC main()
    CONNECT called WITH come;
    ISignalDO doCall,1,called;
    WaitTime 1;
    Set doCall;
    WaitTime 1;
    IDisable;
    Reset doCall;
    Set doCall;
    WaitTime 1;
    told:=TRUE;
    TPWrite "told";                          ! -> told
    IEnable;
    WaitTime 1;
  ENDPROC

  TRAP come
    TPWrite "also here at "\Num:=GetTime(\Sec);
    ! -> also here at 1
    ! -> also here at 3
  ENDTRAP
ENDMODULE
