! RAPID Instructions, IPers: what another task writes is a change, too; the same value is none.
MODULE robot
  PERS num counter:=0;
  VAR intnum changed;

  PROC main()
    CONNECT changed WITH tell;
    IPers counter,changed;
    WaitTime 3;
    IDelete changed;
    TPWrite "last "\Num:=counter;            ! -> last 3
  ENDPROC

  TRAP tell
    TPWrite "counter "\Num:=counter;
    ! -> counter 1
    ! -> counter 2
    ! -> counter 3
  ENDTRAP
ENDMODULE
