! RAPID Instructions, IPers: each change of a persistent runs the trap, a same value does not.
MODULE persistent_changes
  PERS num parts:=0;
  VAR intnum counted;

  PROC main()
    CONNECT counted WITH on_count;
    IPers parts,counted;
    parts:=1;
    WaitTime 0.1;
    parts:=1;
    WaitTime 0.1;
    parts:=2;
    WaitTime 0.1;
  ENDPROC

  TRAP on_count
    TPWrite "parts "\Num:=parts;
    ! -> parts 1
    ! -> parts 2
  ENDTRAP
ENDMODULE
