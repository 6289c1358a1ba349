! ---
MODULE near_miss  PROC main()  ENDPROCENDMODULE