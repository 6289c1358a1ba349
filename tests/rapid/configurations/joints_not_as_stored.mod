! RAPID Functions, CalcJointT: an error that nobody handles stops the program as a move would.
MODULE joints_not_as_stored
  CONST robtarget wound:=[[700,0,600],[0,0,1,0],[0,0,9,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR jointtarget j;
    j:=CalcJointT(wound,tool0);
    ! stops: `the target` cannot be reached in its stored configuration [0,0,9,0]; [0,0,0,0] reaches it
  ENDPROC
ENDMODULE
