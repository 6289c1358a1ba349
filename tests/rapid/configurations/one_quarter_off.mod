! Field practice, Axis configuration: cfx must be the stored one; cf1, cf4 and cf6 may each differ by
! one quarter turn.
MODULE one_quarter_off
  CONST robtarget corner:=[[600,120,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget below:=[[700,-200,600],[0,0,1,0],[0,1,-2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num count;
  VAR jointtarget joints;

  PROC main()
    ! A pallet across y = 0, all of it from one taught point.
    FOR row FROM 0 TO 2 DO
      FOR column FROM 0 TO 3 DO
        MoveJ Offs(corner,70*row,-80*column,60),v1000,z10,tool0;
        MoveL Offs(corner,70*row,-80*column,0),v200,fine,tool0;
        MoveL Offs(corner,70*row,-80*column,60),v200,z10,tool0;
        Incr count;
      ENDFOR
    ENDFOR
    TPWrite "placed "\Num:=count;       ! -> placed 12
    MoveJ below,v500,fine,tool0;
    joints:=CalcJointT(below,tool0);
    TPWrite "axis 1 "\Num:=Round(joints.robax.rax_1);   ! -> axis 1 -16
    WaitTime 0.1;
  ENDPROC
ENDMODULE
