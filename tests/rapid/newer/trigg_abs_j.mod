! RAPID Instructions, TriggAbsJ: as MoveAbsJ, with what happens on the way (RobotWare 7).
MODULE trigg_abs_j
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget aside:=[[40,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR triggdata gun;
  VAR intnum passed;

  PROC main()
    VAR jointtarget now;
    CONNECT passed WITH on_the_way;
    TriggInt gun,0.2\Time,passed;
    MoveAbsJ home,v500,fine,tool0;
    TriggAbsJ aside,v500,gun,fine,tool0;
    now:=CJointT();
    TPWrite ValToStr(Round(now.robax.rax_1)); ! -> 40
  ENDPROC

  TRAP on_the_way
    TPWrite "passed";                       ! -> passed
  ENDTRAP
ENDMODULE
