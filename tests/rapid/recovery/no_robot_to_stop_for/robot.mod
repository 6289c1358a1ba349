! RAPID Instructions, StopMove: whom a watcher stops goes on where it was.
MODULE robot
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
    MoveAbsJ [[30,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
    TPWrite "never";
  ENDPROC
ENDMODULE
