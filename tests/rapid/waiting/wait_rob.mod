! RAPID Instructions, WaitRob: the program goes on when the robot stands at its stop point.
MODULE wait_rob
  CONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b:=[[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveAbsJ a,v1000,fine,tool0;
    MoveAbsJ b,v100,z50,tool0;
    TPWrite ValToStr(axis_1()<19);                    ! -> TRUE
    WaitRob\InPos;
    TPWrite NumToStr(axis_1(),3);                     ! -> 20.000
    MoveAbsJ a,v100,z50,tool0;
    WaitUntil\InPos,TRUE;
    TPWrite NumToStr(axis_1(),3);                     ! -> 0.000
    WaitRob\ZeroSpeed;
    TPWrite "stands";                                 ! -> stands
  ENDPROC

  FUNC num axis_1()
    VAR jointtarget here;
    here:=CJointT();
    RETURN here.robax.rax_1;
  ENDFUNC
ENDMODULE
