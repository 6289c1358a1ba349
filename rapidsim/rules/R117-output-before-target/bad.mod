MODULE example
  CONST robtarget p:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldo grip;
  PROC main()
    AliasIO "doGrip",grip;
    MoveJ p,v500,fine,tool0;
    MoveL Offs(p,0,200,0),v500,z10,tool0;
    grip_close;
    MoveL Offs(p,150,200,0),v500,fine,tool0;
  ENDPROC
  PROC grip_close()
    SetDO grip,1; ! found
  ENDPROC
ENDMODULE
