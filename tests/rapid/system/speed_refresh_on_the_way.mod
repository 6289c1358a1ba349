! RAPID Instructions, SpeedRefresh: a move under way keeps its speed here, and the run says so.
MODULE speed_refresh_on_the_way
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget aside:=[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum slower;

  PROC main()
    MoveAbsJ home,v300,fine,tool0;
    CONNECT slower WITH slow_down;
    ITimer\Single,0.2,slower;
    MoveAbsJ aside,v300,fine,tool0;
    TPWrite ValToStr(CSpeedOverride());     ! -> 50
  ENDPROC

  TRAP slow_down
    SpeedRefresh 50;                        ! warning: R104
  ENDTRAP
ENDMODULE
