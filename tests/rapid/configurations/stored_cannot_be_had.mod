! RAPID Instructions, ConfJ: a stored configuration that cannot be had stops the program.
MODULE stored_cannot_be_had
  CONST robtarget stale:=[[600,0,600],[0,0,1,0],[3,0,0,2],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    TPWrite "before";                   ! -> before
    MoveJ stale,v500,fine,tool0;        ! stops: `stale` cannot be reached in its stored configuration [3,0,0,2]; [0,0,0,0] reaches it
    TPWrite "never";
  ERROR
    TPWrite "never, no clause can help";
    TRYNEXT;
  ENDPROC
ENDMODULE
