MODULE example
  VAR intnum pressed;
  VAR signaldi button;
  VAR signaldi released;
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI button,1,pressed;
    WaitTime 9;
  ENDPROC
  TRAP hold
    StopMove; ! found
    IF DInput(released)=0 RETURN;
    StartMove;
  ENDTRAP
ENDMODULE
! ---
MODULE bad
  VAR intnum pressed;
  VAR signaldi button;
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI button,1,pressed;
    WaitTime 9;
  ENDPROC
  TRAP hold
    StopMove\Quick;                   ! found
    TPWrite "held";
  ENDTRAP
ENDMODULE
