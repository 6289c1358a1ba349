! RAPID Instructions, ConfJ: with \Off the nearest configuration is taken without a word.
MODULE stored_is_not_asked_for
  CONST robtarget stale:=[[600,0,600],[0,0,1,0],[3,0,0,2],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR robtarget now;
    ConfJ \Off;
    MoveJ stale,v500,fine,tool0;
    now:=CRobT(\Tool:=tool0);
    TPWrite "cfx "\Num:=now.robconf.cfx;         ! -> cfx 0
  ENDPROC
ENDMODULE
