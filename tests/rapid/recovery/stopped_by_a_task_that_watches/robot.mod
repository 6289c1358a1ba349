! RAPID Instructions, StopMove: a task without a robot stops the one that it is connected to.
MODULE robot
  CONST jointtarget j1:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget j2:=[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR clock time;

  PROC main()
    MoveAbsJ j1,v100,fine,tool0;
    ClkStart time;
    MoveAbsJ j2,v1000\T:=2,fine,tool0;
    IF ClkRead(time)>9 TPWrite "held for long";                  ! -> held for long
    MoveAbsJ j1\NoEOffs,v1000\T:=2,fine,tool0;
    StopMove;
    WaitTime 1;
    TPWrite "task "\Bool:=IsStopMoveAct(\FromMoveTask);           ! -> task TRUE
    WaitTime 2;
    TPWrite "watcher "\Bool:=IsStopMoveAct(\FromNonMoveTask);     ! -> watcher TRUE
    StartMove;
    TPWrite "task "\Bool:=IsStopMoveAct(\FromMoveTask);           ! -> task FALSE
    TPWrite "any "\Bool:=IsStopMoveAct();                         ! -> any TRUE
    MoveAbsJ j1,v100,fine,tool0;
    TPWrite "any "\Bool:=IsStopMoveAct();                         ! -> any FALSE
  ENDPROC
ENDMODULE
