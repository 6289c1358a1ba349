! RAPID Overview, Positioning during program execution: a corner between a joint move and a line.
MODULE joint_to_line
  CONST robtarget p:=[[900,200,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget q:=[[900,-200,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    ConfJ \Off;
    ConfL \Off;
    MoveJ p,v500,z50,tool0;
    MoveL q,v500,z50,tool0;
    MoveJ p,v500,fine,tool0;
    TPWrite "through";        ! -> through
  ENDPROC
ENDMODULE
