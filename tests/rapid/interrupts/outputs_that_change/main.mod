! RAPID Instructions, ISignalDO, PulseDO and SetDO: each edge of an output is an interrupt.
MODULE outputs_that_change
  VAR intnum flank;
  VAR num flanks;

  PROC main()
    CONNECT flank WITH on_flank;
    ISignalDO doOne,edge,flank;
    Set doOne;
    Reset doOne;
    InvertDO doOne;
    WaitTime 0.1;
    TPWrite ValToStr(flanks);               ! -> 3
    IDelete flank;
    PulseDO\PLength:=0.5,doTwo;
    TPWrite ValToStr(DOutput(doTwo));       ! -> 1
    WaitTime 0.6;
    TPWrite ValToStr(DOutput(doTwo));       ! -> 0
    SetDO\SDelay:=0.3,doTwo,1;
    TPWrite ValToStr(DOutput(doTwo));       ! -> 0
    WaitTime 0.4;
    TPWrite ValToStr(DOutput(doTwo));       ! -> 1
    SetGO goOne,5;
    SetAO aoOne,2.5;
    TPWrite ValToStr(GOutput(goOne))+" "+ValToStr(AOutput(aoOne));    ! -> 5 2.5
  ENDPROC

  TRAP on_flank
    Incr flanks;
  ENDTRAP
ENDMODULE
