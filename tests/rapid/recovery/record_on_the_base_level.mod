! RAPID Instructions, PathRecMoveBwd: the path must be stored before the robot goes back on it.
MODULE record_on_the_base_level
  CONST jointtarget j1:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget j2:=[[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR pathrecid begin;

  PROC main()
    MoveAbsJ j1,v500,fine,tool0;
    PathRecStart begin;
    MoveAbsJ j2,v500,fine,tool0;
    TPWrite "back "\Bool:=PathRecValidBwd();     ! -> back TRUE
    PathRecMoveBwd;                              ! stops: a recorded path is not travelled on the base level; StorePath first
  ENDPROC
ENDMODULE
