! RAPID Kernel, Predefined data objects: ERRNO and INTNO can only be used in an expression.
MODULE data_of_the_controller
  VAR intnum tick;

  PROC main()
    VAR num last;
    last:=ERRNO;
    ERRNO:=1;                 ! error: T304
    INTNO:=tick;              ! error: T304
    Incr ERRNO;               ! error: T303
    keep ERRNO;               ! error: T303
    show ERRNO;
  ENDPROC

  PROC keep(INOUT num value)
    value:=0;
  ENDPROC

  PROC show(num value)
    TPWrite ""\Num:=value;
  ENDPROC

  TRAP on_tick
    TEST INTNO
    CASE tick:
      IDelete INTNO;          ! error: T303
    ENDTEST
  ENDTRAP
ENDMODULE
