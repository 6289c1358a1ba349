MODULE example
  CONST robtarget p:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget turned:=[[700,0,600],[0,0.9659258,0.258819,0],[0,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p,v500,fine,tool0;
    MoveL turned,[100,50,100,50],fine,tool0; ! found
  ENDPROC
ENDMODULE
