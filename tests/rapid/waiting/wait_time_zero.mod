! RAPID Instructions, WaitTime: no time lets the robot fly on; with \InPos it waits until it stands.
MODULE wait_time_zero
  CONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b:=[[30,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget c:=[[30,-20,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR clock watch;
  VAR num began;

  PROC main()
    VAR jointtarget there;
    MoveAbsJ a,v1000,fine,tool0;
    MoveAbsJ b,v1000,z50,tool0;
    WaitTime 0;
    there:=CJointT();
    TPWrite ValToStr(there.robax.rax_1<29);           ! -> TRUE
    MoveAbsJ c,v1000,fine,tool0;
    MoveAbsJ b,v1000,z50,tool0;
    WaitTime\InPos,0;
    there:=CJointT();
    TPWrite NumToStr(there.robax.rax_2,3);            ! -> 0.000
    ClkReset watch;
    ClkStart watch;
    WaitTime\InPos,0.5;
    ClkStop watch;
    TPWrite ValToStr(ClkRead(watch));                 ! -> 0.5
  ENDPROC
ENDMODULE
