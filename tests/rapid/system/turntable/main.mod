! RAPID Instructions, IndAMove, IndRMove, IndDMove, IndCMove, IndReset: a table on its own time.
MODULE turntable
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[0,9E9,9E9,9E9,9E9,9E9]];
  VAR clock watch;
  VAR jointtarget here;

  PROC main()
    MoveJ p1,v500,fine,tool0;
    ClkStart watch;
    IndAMove TABLE,1\ToAbsNum:=90,50;         ! warning: R104
    TPWrite "there "\Bool:=IndInpos(TABLE,1);             ! -> there FALSE
    WaitUntil IndInpos(TABLE,1)=TRUE\PollRate:=0.05;
    TPWrite "90 degrees take "\Num:=Round(ClkRead(watch)\Dec:=1);           ! -> 90 degrees take 2.3
    TPWrite "stands "\Bool:=IndSpeed(TABLE,1\ZeroSpeed);             ! -> stands TRUE
    ! It keeps turning while the robot works, and what targets say of it does not count.
    IndCMove TABLE,1,-50;       ! warning: R104
    MoveL Offs(p1,0,100,0),v500,fine,tool0;
    WaitUntil IndSpeed(TABLE,1\InSpeed);
    TPWrite "there "\Bool:=IndInpos(TABLE,1);             ! -> there FALSE
    IndReset TABLE,1\Old;
    TPWrite "reset";             ! -> reset
    ! Targets count for it again.
    MoveL Offs(p1,0,100,50),v500,fine,tool0;
    here:=CJointT();
    TPWrite "table at "\Num:=Round(here.extax.eax_a);             ! -> table at 0
    ! The shorter way of 270 degrees is 90 back.
    ClkReset watch;
    ClkStart watch;
    IndRMove TABLE,1\ToRelNum:=270\Short,50;             ! warning: R104
    WaitUntil IndInpos(TABLE,1)\PollRate:=0.05;
    TPWrite "took "\Num:=Round(ClkRead(watch)\Dec:=1);             ! -> took 2.3
    IndDMove TABLE,1,-30,20\Ramp:=50;         ! warning: R104
    WaitTime 3;
    TPWrite "there "\Bool:=IndInpos(TABLE,1);             ! -> there TRUE
    IndReset TABLE,1\RefNum:=0\Short;
    DeactUnit TABLE;
    IndCMove TABLE,1,10;
    TPWrite "is "\Bool:=IndInpos(TABLE,1);
  ERROR
    TEST ERRNO
    CASE ERR_AXIS_MOVING:
      TPWrite "it moves";             ! -> it moves
      IndCMove TABLE,1,0;
      WaitUntil IndSpeed(TABLE,1\ZeroSpeed);
      RETRY;
    CASE ERR_AXIS_ACT:
      TPWrite "it is off";             ! -> it is off
      ActUnit TABLE;
      TRYNEXT;
    CASE ERR_AXIS_IND:
      TPWrite "it belongs to the path";             ! -> it belongs to the path
      TRYNEXT;
    ENDTEST
  ENDPROC
ENDMODULE
