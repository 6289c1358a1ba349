! RAPID Instructions, StorePath: with \KeepSync the robots of a team leave their path together, and
! SyncMoveSuspend lets each move alone up to SyncMoveResume; RestoPath and StartMove take it up again.
MODULE right
  PERS tasks both{2}:=[["T_LEFT"],["T_RIGHT"]];
  VAR syncident on;
  VAR syncident off;
  VAR intnum soon;
  VAR robtarget here;
  CONST robtarget p1:=[[800,300,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[800,200,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p1,v500,fine,tool0;
    SyncMoveOn on,both;
    CONNECT soon WITH aside;
    ITimer\Single,0.6,soon;
    MoveL p2\ID:=10,v200,fine,tool0;
    MoveL p1\ID:=20,v200,fine,tool0;
    SyncMoveOff off;
  ENDPROC

  TRAP aside
    StopMove;
    StorePath\KeepSync;
    here:=CRobT(\Tool:=tool0);
    MoveL Offs(here,0,0,40)\ID:=100,v200,fine,tool0;
    SyncMoveSuspend;
    MoveL Offs(here,30,0,40),v200,fine,tool0;
    SyncMoveResume;
    MoveL here\ID:=101,v200,fine,tool0;
    RestoPath;
    StartMove;
  ENDTRAP
ENDMODULE
