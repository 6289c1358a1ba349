! RAPID Functions, CRobT, CalcRobT: a coordinate that is 0 is printed as 0, not as what rounding left.
MODULE no_noise_in_positions
  CONST robtarget p1:=[[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST pose shift:=[[10,20,30],[1,0,0,0]];

  PROC main()
    VAR robtarget here;
    VAR jointtarget joints;
    PDispSet shift;
    MoveJ p1,v500,fine,tool0;
    TPWrite ""\Pos:=CPos(\Tool:=tool0\WObj:=wobj0);       ! -> [600,0,800]
    PDispOff;
    MoveL p1,v500,fine,tool0;
    here:=CRobT(\Tool:=tool0\WObj:=wobj0);
    TPWrite ValToStr(here.rot);     ! -> [0,0,1,0]
    joints:=CJointT();
    TPWrite ValToStr(joints.robax.rax_1);       ! -> 0
    here:=CalcRobT(joints,tool0);
    TPWrite ""\Pos:=here.trans;      ! -> [600,0,800]
  ENDPROC
ENDMODULE
