MODULE example
  CONST robtarget pAway:=[[200,600,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPart:=[[0,0,50],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS wobjdata wCnv:=[FALSE,FALSE,"CNV1",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PROC main()
    ConfJ\Off;
    ConfL\Off;
    MoveJ pAway,v1000,fine,tool0;
    WaitWObj wCnv\RelDist:=300;
    MoveL pPart,v500,fine,tool0\WObj:=wCnv; ! found
    WaitTime 6;
  ENDPROC
ENDMODULE
