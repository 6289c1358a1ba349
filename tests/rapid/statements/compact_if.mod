! RAPID Kernel, Compact IF: one simple statement, without THEN and without ELSE.
MODULE compact_if
  VAR num n;
  VAR intnum tick;
  VAR string name:="show";

  PROC main()
    IF n=0 n:=1;
    IF n=1 TPWrite "one";         ! -> one
    IF n=2 TPWrite "two";
    IF n=1 CONNECT tick WITH on_tick;
    IF n=1 %name%;
    IF n=1 GOTO over;
    TPWrite "never";
    over:
    IF n=1 attempt;
    IF n=1 RETURN;
    TPWrite "never";
  ENDPROC

  PROC show()
    TPWrite "shown";              ! -> shown
  ENDPROC

  PROC attempt()
    IF n=1 RAISE 7;
    TPWrite "after";              ! -> after
  ERROR
    IF ERRNO=7 TRYNEXT;
  ENDPROC

  TRAP on_tick
  ENDTRAP
ENDMODULE
