MODULE example
  CONST robtarget pAway:=[[900,0,900],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPart:=[[0,0,50],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS wobjdata wCnv:=[FALSE,FALSE,"CNV1",[[900,0,800],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PROC main()
    MoveJ pAway,v1000,fine,tool0;
    WaitWObj wCnv;
    MoveL pPart,v500,fine,tool0\WObj:=wCnv; ! found
    DropWObj wCnv;
  ENDPROC
ENDMODULE
