! RAPID Instructions, WaitSyncTask: a task that meets the others once and then has other work.
MODULE second
  PERS tasks both{2}:=[["T_ROB1"],["T_BACK"]];
  VAR syncident here;

  PROC main()
    WaitTime 2;
    WaitSyncTask here,both;
    WaitTime 3;
  ENDPROC
ENDMODULE
