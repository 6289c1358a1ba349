! RAPID Instructions, WaitTestAndSet: a flag that is free is taken at once.
MODULE limit_of_a_flag
  PERS bool taken:=FALSE;
  VAR clock watch;

  PROC main()
    ClkStart watch;
    WaitTestAndSet taken;
    TPWrite "taken "\Bool:=taken;       ! -> taken TRUE
    TPWrite "after "\Num:=ClkRead(watch);        ! -> after 0
  ENDPROC
ENDMODULE
