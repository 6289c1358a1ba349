! RAPID Instructions, ISignalGO: groups and inputs that interrupt; a stimulus of the cell.
MODULE groups_and_inputs
  VAR intnum a;
  VAR intnum b;
  VAR intnum c;

  PROC main()
    CONNECT a WITH told;
    CONNECT b WITH told;
    CONNECT c WITH told;
    ISignalGO goPart,a;
    ISignalDI diGo,1,b;
    ISignalAI\Single,aiFlow,AIO_ABOVE_HIGH,5,1,0,c;
    SetGO goPart,3;
    SetGO goPart,3;
    SetGO goPart,4;
    WaitTime 2;
    TPWrite "end";                          ! -> end
  ENDPROC

  TRAP told
    TEST INTNO
    CASE a:
      TPWrite "group "\Num:=GOutput(goPart); ! -> group 3 ! -> group 4
    CASE b:
      TPWrite "input";                      ! -> input
    CASE c:
      TPWrite "analog "\Num:=AInput(aiFlow); ! -> analog 6
    ENDTEST
  ENDTRAP
ENDMODULE
