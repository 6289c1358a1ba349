MODULE conveyor
  PERS wobjdata wCnv:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pPick:=[[10,20,5],[0,1,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,0]];
  PROC main()
    ActUnit CNV1;
    WaitWObj wCnv\RelDist:=50;
    MoveL pPick,v500,z10,tool0\WObj:=wCnv;
    DropWObj wCnv;
    DeactUnit CNV1;
  ENDPROC
ENDMODULE
