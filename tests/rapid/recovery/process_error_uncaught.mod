! RAPID Instructions, ProcerrRecovery: without an ERROR clause the program ends at the move.
MODULE process_error_uncaught
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum torch;

  PROC main()
    CONNECT torch WITH on_torch;
    ITimer\Single,0.5,torch;
    MoveAbsJ home\NoEOffs,v100,fine,tool0;
    MoveAbsJ [[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;    ! stops: ProcerrRecovery stopped the robot on its path (ERR_PATH_STOP)
  ENDPROC

  TRAP on_torch
    ProcerrRecovery\SyncLastMoveInst;
  ENDTRAP
ENDMODULE
