! RAPID Instructions, UIMsgWrite: a message is shown and the program goes on.
MODULE message_written
  PROC main()
    UIMsgWrite "Cell","door is open"\Icon:=iconWarning; ! -> Cell / door is open
    UIMsgWriteAbort;
    TPWrite "on";                           ! -> on
  ENDPROC
ENDMODULE
