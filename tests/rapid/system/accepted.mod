! RAPID Instructions, SoftAct: what no run shows is accepted, with a note.
MODULE accepted
  PROC main()
    SoftAct 3,20\Ramp:=150;                 ! note: R119
    SoftDeact;                              ! note: R119
    TuneServo ROB_1,1,110;                  ! note: R119
    TuneReset;                              ! note: R119
    PathResol 150;                          ! note: R119
    MotionSup\On\TuneValue:=200;            ! note: R119
    CornerPathWarning FALSE;                ! note: R119
    TPWrite ValToStr(C_MOTSET.pathresol);   ! -> 150
    TPWrite ValToStr(C_MOTSET.tunevalue);   ! -> 200
    TPWrite ValToStr(C_MOTSET.motionsup);   ! -> TRUE
  ENDPROC
ENDMODULE
