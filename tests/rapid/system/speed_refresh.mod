! RAPID Instructions, SpeedRefresh: an override beside that of VelSet, for the moves to come.
MODULE speed_refresh
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget aside:=[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST speeddata turning:=[7000,60,0,0];

  PROC main()
    VAR num full;
    MoveAbsJ home,vmax,fine,tool0;
    full:=seconds(aside);
    SpeedRefresh 25;
    TPWrite ValToStr(CSpeedOverride());     ! -> 25
    TPWrite ValToStr(seconds(home)>2*full); ! -> TRUE
    TPWrite ValToStr(C_MOTSET.vel.oride);   ! -> 100
    SpeedRefresh 100;
    ! A stop after a slow move costs less.
    TPWrite ValToStr(Abs(seconds(aside)-full)<0.06); ! -> TRUE
  ENDPROC

  FUNC num seconds(jointtarget there)
    VAR clock watch;
    ClkStart watch;
    MoveAbsJ there,v300,fine,tool0;
    RETURN ClkRead(watch);
  ENDFUNC
ENDMODULE
