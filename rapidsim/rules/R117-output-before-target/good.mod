MODULE example
  CONST robtarget p:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldo grip;
  PROC main()
    AliasIO "doGrip",grip;
    MoveJ p,v500,fine,tool0;
    MoveLDO Offs(p,0,200,0),v500,z10,tool0,grip,1;
    MoveL Offs(p,150,200,0),v500,fine,tool0;
    SetDO grip,0;
  ENDPROC
ENDMODULE
