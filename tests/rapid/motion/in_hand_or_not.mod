! RAPID Instructions, tooldata: either the tool or the work object is in the robot's hand.
MODULE in_hand_or_not
  PERS tooldata glue:=[FALSE,[[900,0,700],[0,1,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
  CONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ p,v500,fine,glue;   ! error: M522
  ENDPROC
ENDMODULE
