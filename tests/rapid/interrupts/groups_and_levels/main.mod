! RAPID Instructions, ISignalGI and ISignalAI: a group that changes, a level that is passed.
MODULE groups_and_levels
  VAR intnum group;
  VAR intnum level;

  PROC main()
    CONNECT group WITH on_group;
    ISignalGI giOne,group;
    CONNECT level WITH on_level;
    ISignalAI\Single,aiOne,AIO_ABOVE_HIGH,5,1,0,level;
    WaitTime 4;
    TPWrite "end";                          ! -> end
  ENDPROC

  TRAP on_group
    TPWrite "group "\Num:=GInput(giOne);    ! -> group 3 ! -> group 0
  ENDTRAP

  TRAP on_level
    TPWrite "level "\Num:=AInput(aiOne);    ! -> level 7
  ENDTRAP
ENDMODULE
