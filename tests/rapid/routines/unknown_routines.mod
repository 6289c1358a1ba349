! RAPID Kernel, Scope rules: a procedure or function that nothing declares keeps a program from loading.
MODULE unknown_routines
  VAR num n:=1;

  PROC main()
    OpenGripper;                          ! error: N209
    n:=ReadSensor(3);                     ! error: N209
    MovJ home,v1000,fine,tool0;           ! error: N209
    PickPrat;                             ! error: N209
    TPWrite "n is "\Num:=n;
  ENDPROC
  PROC PickPart()
  ENDPROC
ENDMODULE
