! RAPID Instructions, StorePath: no \Conc between StorePath and RestoPath.
MODULE concurrent_on_a_stored_path
  PROC main()
    StorePath;
    MoveAbsJ\Conc,[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;    ! stops: MoveAbsJ \Conc between StorePath and RestoPath is not allowed
  ERROR
    TPWrite "never";
    TRYNEXT;
  ENDPROC
ENDMODULE
