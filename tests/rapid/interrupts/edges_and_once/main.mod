! RAPID Instructions, ISignalDI: \Single comes once, edge both ways, a level that is there is no edge.
MODULE edges_and_once
  VAR intnum once;
  VAR intnum both;
  VAR intnum timed;

  PROC main()
    CONNECT once WITH up;
    ISignalDI\Single,diPart,1,once;
    CONNECT both WITH changed;
    ISignalDI diPart,edge,both;
    CONNECT timed WITH late;
    ITimer\Single,2.5,timed;
    WaitTime 1;
    TPWrite "nothing yet";                   ! -> nothing yet
    WaitTime 5;
  ENDPROC

  TRAP up
    TPWrite "up";                            ! -> up
  ENDTRAP

  TRAP changed
    TPWrite "now "\Num:=diPart;
    ! -> now 0
    ! -> now 1
    ! -> now 0
    ! -> now 1
  ENDTRAP

  TRAP late
    TPWrite "timer";                         ! -> timer
  ENDTRAP
ENDMODULE
