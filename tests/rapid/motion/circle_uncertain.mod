! RAPID Instructions, MoveC: three points on a line are no circle.
MODULE circle_uncertain
  CONST robtarget start:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ start,v500,fine,tool0;
    MoveC Offs(start,0,50,0),Offs(start,0,100,0),v200,fine,tool0;   ! error: M506
  ENDPROC
ENDMODULE
