! RAPID Kernel, CONNECT: an intnum variable, and a trap.
MODULE connect_wrong
  VAR intnum tick;
  VAR string text;
  CONST intnum fixed:=1;

  PROC main()
    CONNECT tick WITH nothing;          ! error: N201
    CONNECT tick WITH show;             ! error: F416
    CONNECT text WITH on_tick;          ! error: F416
    CONNECT fixed WITH on_tick;         ! error: T304
  ENDPROC

  PROC show()
  ENDPROC

  TRAP on_tick
  ENDTRAP
ENDMODULE
