! Field practice, Routines of other modules: on request a call that nothing answers is skipped.
MODULE assumed_routines
  VAR num n:=1;

  PROC main()
    OpenGripper;                          ! warning: N209 ! warning: R104
    n:=ReadSensor(3);                     ! warning: N209 ! warning: R104
    TPWrite "n is "\Num:=n;               ! -> n is 0
  ENDPROC
ENDMODULE
