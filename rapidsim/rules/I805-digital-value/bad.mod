MODULE example
  VAR signaldo valve;
  PROC main()
    SetDO valve,2; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST num open:=10;
  VAR signaldo valve;
  VAR signaldi button;
  PROC main()
    SetDO\SDelay:=2,valve,-1;          ! found
    SetDO valve,open;                  ! found
    WaitDI button,0.5\MaxTime:=3;      ! found
    WaitDO valve,2\MaxTime:=3;         ! found
  ENDPROC
ENDMODULE
