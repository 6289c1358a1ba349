! RAPID Instructions, PathRecMoveBwd: a move of the axes goes back to the axis positions it left.
MODULE record_joint_moves
  CONST extjoint none:=[9E9,9E9,9E9,9E9,9E9,9E9];
  VAR pathrecid begin;

  PROC main()
    VAR jointtarget now;
    MoveAbsJ [[10,0,0,0,30,0],none],v1000,fine,tool0;
    PathRecStart begin;
    MoveAbsJ [[40,10,0,0,60,90],none],v1000,z50,tool0;
    MoveAbsJ [[20,0,10,0,30,0],none],v1000,fine,tool0;
    StorePath;
    PathRecMoveBwd \ID:=begin;
    now:=CJointT();
    TPWrite "axis 1 "\Num:=Round(now.robax.rax_1);          ! -> axis 1 10
    PathRecMoveFwd;
    now:=CJointT();
    TPWrite "axis 1 "\Num:=Round(now.robax.rax_1);          ! -> axis 1 20
    RestoPath;
    StartMove;
  ENDPROC
ENDMODULE
