! RAPID Kernel, Trap declarations: LOCAL as for other routines; INTNO tells which interrupt it is.
MODULE local_traps
  VAR intnum first;
  VAR intnum second;

  PROC main()
    CONNECT first WITH on_first;
    CONNECT second WITH on_second;
    ITimer\Single,2,first;
    ITimer\Single,1,second;
    WaitTime 3;
  ENDPROC

  LOCAL TRAP on_first
    TPWrite "first"\Bool:=INTNO=first;    ! -> firstTRUE
  ENDTRAP

  LOCAL TRAP on_second()
    TPWrite "second"\Bool:=INTNO=second;  ! -> secondTRUE
  ENDTRAP
ENDMODULE
