! RAPID Kernel, Blocks: each has an end word of its own.
MODULE blocks_open
  VAR num n;

  PROC main()
    IF n=1 THEN
      n:=2;                           ! error: E102
  ENDPROC

  PROC other()
    ENDIF                             ! error: E115
    n:=3;
  ENDPROC
ENDMODULE
