! Field practice, Axis configuration: two quarter turns off and more, with cfx as stored, are warned
! of, and the program goes on.
MODULE two_quarters_off
  CONST robtarget a:=[[700,200,600],[0,0,1,0],[2,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[700,-200,600],[0,0,1,0],[-1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget c:=[[700,100,600],[0,0,1,0],[0,3,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR jointtarget joints;
    MoveJ a,v500,fine,tool0;            ! warning: K603
    MoveL b,v500,fine,tool0;            ! warning: K606
    joints:=CalcJointT(a,tool0);        ! warning: K603
    TPWrite "axis 1 "\Num:=Round(joints.robax.rax_1);   ! -> axis 1 16
    ! The fourth axis cannot turn so far, and would have to: that is no quarter turn off.
    MoveJ c,v500,fine,tool0;      ! stops: `c` cannot be reached in its stored configuration [0,3,0,0]; [0,0,0,0] reaches it
  ENDPROC
ENDMODULE
