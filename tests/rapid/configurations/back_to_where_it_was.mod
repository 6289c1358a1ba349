! RAPID Functions, CRobT: a target that was read has the configuration the arm stands in.
MODULE back_to_where_it_was
  CONST extjoint none:=[9E9,9E9,9E9,9E9,9E9,9E9];

  PROC main()
    VAR robtarget here;
    VAR jointtarget before;
    VAR jointtarget now;
    MoveAbsJ [[-40,10,20,100,-50,-200],none],vmax,fine,tool0;
    here:=CRobT(\Tool:=tool0);
    before:=CJointT();
    MoveAbsJ [[0,0,0,0,30,0],none],vmax,fine,tool0;
    MoveJ here,vmax,fine,tool0;
    now:=CJointT();
    TPWrite "axis 4 "\Num:=Round(now.robax.rax_4-before.robax.rax_4);         ! -> axis 4 0
    TPWrite "axis 6 "\Num:=Round(now.robax.rax_6-before.robax.rax_6);         ! -> axis 6 0
  ENDPROC
ENDMODULE
