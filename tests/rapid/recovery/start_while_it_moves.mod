! RAPID Instructions, StartMove: ERR_ALRDY_MOVING, where nothing stopped the robot.
MODULE start_while_it_moves
  CONST jointtarget away:=[[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    StartMove;
    TPWrite "it stood";               ! -> it stood
    MoveAbsJ \Conc,away,v100,fine,tool0;
    WaitTime 0.2;
    StartMove;
    StopMove;
    StartMove;
    TPWrite "it goes on";             ! -> it goes on
  ERROR
    TPWrite ValToStr(ERRNO=ERR_ALRDY_MOVING); ! -> TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
