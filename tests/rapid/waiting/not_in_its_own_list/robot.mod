! RAPID Instructions, WaitSyncTask: whoever waits must be in the list of those that wait.
MODULE robot
  PERS tasks listed{2}:=[["T_OTHER"],["T_WATCH"]];
  VAR syncident here;

  PROC main()
    WaitSyncTask here,listed\TimeOut:=5;
    ! stops: WaitSyncTask: T_ROB1 is not in its own list of tasks (ERR_ARGVALERR)
  ENDPROC
ENDMODULE
