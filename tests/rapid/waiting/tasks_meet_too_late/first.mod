! RAPID Instructions, WaitSyncTask: \TimeOut ends the wait with ERR_WAITSYNCTASK.
MODULE first
  PERS tasks both{2}:=[["T_ROB1"],["T_BACK"]];
  VAR syncident here;
  VAR syncident there;

  PROC main()
    WaitSyncTask here,both\TimeOut:=5;
    TPWrite "together";                 ! -> together
    WaitSyncTask there,both\TimeOut:=1; ! stops: WaitSyncTask there: the others did not come within 1 s (ERR_WAITSYNCTASK)
  ENDPROC
ENDMODULE
