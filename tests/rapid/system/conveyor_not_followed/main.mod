! Field practice, Conveyor tracking: that a robot follows a conveyor is not simulated; the run ends there.
MODULE conveyor_not_followed
  PERS wobjdata wCnv:=[FALSE,FALSE,"CNV1",[[900,0,800],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p:=[[0,0,50],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ActUnit CNV1;
    WaitWObj wCnv;
    TPWrite "taken";                        ! -> taken
    MoveL p,v500,fine,tool0\WObj:=wCnv;     ! error: R131
    TPWrite "never";
  ERROR
    TPWrite "never";
  ENDPROC
ENDMODULE
