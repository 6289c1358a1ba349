MODULE example
  CONST robtarget pPick:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlace:=[[600,300,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS loaddata part:=[2.5,[0,0,50],[1,0,0,0],0,0,0];
  PROC main()
    MoveJ pPlace,v500,fine,tool0;
    SetDO doGrip,0; ! found
    WaitDI diGripped,0\MaxTime:=2;
    MoveJ Offs(pPlace,0,0,50),v500,fine,tool0;
  ENDPROC
ENDMODULE
