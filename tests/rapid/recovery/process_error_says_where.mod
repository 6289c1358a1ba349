! RAPID Instructions, ProcerrRecovery: one of the two switches is needed.
MODULE process_error_says_where
  PROC main()
    ProcerrRecovery;                    ! stops: ProcerrRecovery needs \SyncOrgMoveInst or \SyncLastMoveInst
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
ENDMODULE
