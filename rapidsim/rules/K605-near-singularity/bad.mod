MODULE example
  CONST robtarget a:=[[780,10,850],[0.7071068,0,0.7071068,0],[0,0,-1,1],
    [9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[780,10,1050],[0.7071068,0,0.7071068,0],[0,1,-2,1],
    [9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a,v500,fine,tool0;
    MoveL b,v500,fine,tool0; ! found
  ENDPROC
ENDMODULE
