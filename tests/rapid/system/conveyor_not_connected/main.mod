! Field practice, Conveyor tracking: without a connected object the work object of a conveyor has no place.
MODULE conveyor_not_connected
  PERS wobjdata wCnv:=[FALSE,FALSE,"CNV1",[[900,0,800],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget p:=[[0,0,50],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ActUnit CNV1;
    WaitWObj wCnv;
    DropWObj wCnv;
    TPWrite "dropped";                      ! -> dropped
    MoveL p,v500,fine,tool0\WObj:=wCnv;     ! error: R131
    TPWrite "never";
  ERROR
    TPWrite "never";
  ENDPROC
ENDMODULE
