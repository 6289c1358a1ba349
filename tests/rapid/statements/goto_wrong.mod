! RAPID Kernel, GOTO: never into another block, another routine or another clause.
MODULE goto_wrong
  VAR num n;

  PROC main()
    GOTO nowhere;                     ! error: F405
    GOTO inside;                      ! error: F405 ! warning: F401
    GOTO elsewhere;                   ! error: F405
    WHILE n<3 DO
      inside:
      Incr n;
    ENDWHILE
    out:
  ERROR
    GOTO out;                         ! error: F405
  ENDPROC

  PROC other()
    elsewhere:
  ENDPROC
ENDMODULE
