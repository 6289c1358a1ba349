! Field practice, Options: on request an instruction of a process that is not there is skipped.
MODULE unknown_instruction
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    GlueStart 1,"bead"\Fast;              ! warning: N209 ! warning: R104
    MoveAbsJ jHome,v1000,fine,tool0;
    SetDO doGlue,1;                       ! warning: I801
    TPWrite "glued";                      ! -> glued
  ENDPROC
ENDMODULE
