! RAPID Instructions, TriggStopProc: while nothing stops the program there is nothing to note.
MODULE restart_data
  PERS restartdata restart:=[FALSE,FALSE,0,0,0,0,0,0,0,0,0,0,0,0,0];

  PROC main()
    TriggStopProc restart\DO1:=doGlue\GO1:=goFlow,doShadow;
    SetDO doGlue,1;
    StopMove;
    StartMove;
    TPWrite ValToStr(restart.restartstop);         ! -> FALSE
    TPWrite ValToStr(doGlue);                      ! -> 1
  ENDPROC
ENDMODULE
