! RAPID Instructions, SetupCyclicBool: a persistent and an output follow signals and persistents.
MODULE cyclic_bool
  PERS bool both:=FALSE;
  PERS bool ready:=FALSE;
  PERS bool forced:=FALSE;
  VAR signaldi part;
  VAR signaldi door;
  VAR signaldo lamp;

  PROC main()
    VAR clock watch;
    forced:=FALSE;
    AliasIO "diPart",part;
    AliasIO "diDoor",door;
    AliasIO "doLamp",lamp;
    SetupCyclicBool both,part=1 AND door=1\Signal:=lamp;
    SetupCyclicBool ready,both OR forced;
    TPWrite ValToStr(both);                 ! -> FALSE
    WaitUntil both;
    ClkStart watch;
    TPWrite ValToStr(ready)+ValToStr(DOutput(lamp)); ! -> TRUE1
    WaitUntil NOT both;
    TPWrite ValToStr(ClkRead(watch));       ! -> 1
    TPWrite ValToStr(ready)+ValToStr(DOutput(lamp)); ! -> FALSE0
    forced:=TRUE;
    WaitTime 0.05;
    TPWrite ValToStr(ready);                ! -> TRUE
  ENDPROC
ENDMODULE
