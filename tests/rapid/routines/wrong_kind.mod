! RAPID Kernel, Calls: procedures are called by statements, functions in expressions.
MODULE wrong_kind
  VAR num n;

  PROC main()
    n;                                ! error: N211
    half 2;                           ! error: N211
    n:=main();                        ! error: N211
    n:=half;                          ! error: N211
    n:=MoveL(1);                      ! error: N211
    on_tick;                          ! error: N211
  ENDPROC

  FUNC num half(num of)
    RETURN of/2;
  ENDFUNC

  TRAP on_tick
  ENDTRAP
ENDMODULE
