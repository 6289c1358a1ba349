! RAPID Instructions, ProcerrRecovery: nothing stops while the signal of the process is 0.
MODULE process_error_switched_off
  VAR signaldo doArc;

  PROC main()
    AliasIO "doArc",doArc;
    ProcerrRecovery\SyncOrgMoveInst\ProcSignal:=doArc;
    TPWrite "on";                       ! -> on
    SetDO doArc,1;
    ProcerrRecovery\SyncOrgMoveInst\ProcSignal:=doArc;
    StartMove;
    TPWrite "end";                      ! -> end
  ERROR
    TPWrite "off "\Bool:=ERRNO=ERR_PROCSIGNAL_OFF;
    ! -> off TRUE
    ! -> off FALSE
    TRYNEXT;
  ENDPROC
ENDMODULE
