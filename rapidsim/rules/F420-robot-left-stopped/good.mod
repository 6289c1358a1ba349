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
    StopMove;
    WaitDI released,1\MaxTime:=60;
    StartMove;
  ENDTRAP
ENDMODULE
! ---
MODULE near_miss
  VAR intnum pressed;
  VAR signaldi button;
  VAR bool held;
  PROC main()
    CONNECT pressed WITH hold;
    ISignalDI button,1,pressed;
    WaitUntil held\MaxTime:=9;
    ClearPath;
    StartMove;
    CONNECT pressed WITH give_up;
  ENDPROC
  TRAP hold
    StopMove;
    held:=TRUE;
  ENDTRAP
  TRAP give_up
    StopMove;
    IF held THEN
      go_on;
    ELSE
      ExitCycle;
    ENDIF
  ENDTRAP
  PROC go_on()
    StartMove;
  ENDPROC
ENDMODULE
! ---
MODULE handled_elsewhere
  VAR intnum failed;
  CONST jointtarget there:=[[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    CONNECT failed WITH fail;
    ITimer\Single,1,failed;
    MoveAbsJ there,v100,fine,tool0;
  ERROR
    ! The error that the trap raises comes here.
    IF ERRNO=ERR_PATH_STOP StartMoveRetry;
  ENDPROC
  TRAP fail
    ProcerrRecovery\SyncLastMoveInst;
  ENDTRAP
ENDMODULE
