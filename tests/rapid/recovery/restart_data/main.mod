! RAPID Instructions, TriggStopProc: restart data come of program stops, which a run has none of; said.
MODULE restart_data
  PERS restartdata restart:=[FALSE,FALSE,0,0,0,0,0,0,0,0,0,0,0,0,0];

  PROC main()
    TriggStopProc restart\DO1:=doGlue,doShadow;    ! warning: R104
    TPWrite ValToStr(restart.restartstop);         ! -> FALSE
  ENDPROC
ENDMODULE
