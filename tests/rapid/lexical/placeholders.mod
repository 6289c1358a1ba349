! RAPID Kernel, Placeholders: unfinished statements and expressions load.
MODULE placeholders
  VAR num n:=1;
  VAR intnum tick;

  PROC main()
    n:=2;
  ENDPROC

  PROC unfinished()
    <SMT>                       ! warning: E148
    n:=<EXP>;                   ! warning: E148
    <VAR>:=1;                   ! warning: E148
    Add n,<ARG>;                ! warning: E148
    <ID>;                       ! warning: E148
    IF n=1 <SMT>                ! warning: E148
    IF n=1 THEN
      n:=2;
    <EIT>                       ! warning: E148
    ENDIF
    TEST n
    CASE 1:
      n:=2;
    <CSE>                       ! warning: E148
    ENDTEST
    MoveL *,v100,fine,tool0;    ! warning: E148
    CONNECT <VAR> WITH on_tick; ! warning: E148
  ENDPROC

  TRAP on_tick
  ENDTRAP
ENDMODULE
