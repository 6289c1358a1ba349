! RAPID Instructions, ConfL: \On asks for the stored configuration again.
MODULE reset_by_conf_on
  CONST robtarget a:=[[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[700,200,600],[0,0,1,0],[0,2,2,4],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    MoveJ a,v500,fine,tool0;
    ConfL \Off;
    MoveL b,v500,fine,tool0;
    MoveL a,v500,fine,tool0;
    ConfL \On;
    TPWrite "on";                       ! -> on
    MoveL b,v500,fine,tool0;            ! stops: `b` cannot be reached in its stored configuration [0,2,2,4]; [0,2,2,1] reaches it
  ENDPROC
ENDMODULE
