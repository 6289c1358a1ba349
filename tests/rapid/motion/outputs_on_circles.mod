! RAPID Instructions, MoveCDO and MoveCAO: outputs at the end of an arc.
MODULE outputs_on_circles
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldo doAt;
  VAR signalao aoAt;

  PROC main()
    AliasIO "doAt",doAt;
    AliasIO "aoAt",aoAt;
    MoveJ p1,v500,fine,tool0;
    MoveCDO Offs(p1,50,50,0),Offs(p1,0,100,0),v200,fine,tool0,doAt,1;
    TPWrite ValToStr(DOutput(doAt));        ! -> 1
    MoveCAO Offs(p1,50,50,0),p1,v200,fine,tool0,aoAt,2.5;
    TPWrite ValToStr(AOutput(aoAt));        ! -> 2.5
  ENDPROC
ENDMODULE
