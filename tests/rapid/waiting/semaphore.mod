! RAPID Functions, TestAndSet: takes a semaphore; WaitTestAndSet waits for it.
MODULE semaphore
  PERS bool taken:=FALSE;
  VAR intnum later;

  PROC main()
    VAR clock c;
    TPWrite ValToStr(TestAndSet(taken));    ! -> TRUE
    TPWrite ValToStr(TestAndSet(taken));    ! -> FALSE
    CONNECT later WITH give;
    ITimer\Single,1.5,later;
    ClkStart c;
    WaitTestAndSet taken;
    TPWrite ValToStr(Round(ClkRead(c)\Dec:=1)); ! -> 1.5
    TPWrite ValToStr(taken);                ! -> TRUE
  ENDPROC

  TRAP give
    taken:=FALSE;
  ENDTRAP
ENDMODULE
