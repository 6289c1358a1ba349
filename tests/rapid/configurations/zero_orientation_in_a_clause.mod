! RAPID Overview, Targets: a move to a target that nobody has taught stops the program; a function
! raises an error that a clause handles.
MODULE zero_orientation_in_a_clause
  VAR robtarget taught;
  VAR jointtarget joints;

  PROC main()
    taught.trans:=[700,0,600];
    taught.extax:=[9E9,9E9,9E9,9E9,9E9,9E9];
    joints:=CalcJointT(taught,tool0);
    TPWrite "axis 1 "\Num:=Round(joints.robax.rax_1);    ! -> axis 1 0
    taught.rot:=[0,0,0,0];
    MoveJ taught,v500,fine,tool0;      ! error: M501
  ERROR
    TPWrite "teach it";                 ! -> teach it
    taught.rot:=[0,0,1,0];
    RETRY;
  ENDPROC
ENDMODULE
