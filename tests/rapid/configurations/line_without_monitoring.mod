! RAPID Instructions, ConfL: with \Off the line ends as the way leads.
MODULE line_without_monitoring
  CONST robtarget a:=[[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[700,200,600],[0,0,1,0],[0,2,2,1],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR robtarget now;
    MoveJ a,v500,fine,tool0;
    ConfL \Off;
    MoveL b,v500,fine,tool0;
    now:=CRobT(\Tool:=tool0);
    TPWrite ValToStr(now.robconf);      ! -> [0,0,0,0]
  ENDPROC
ENDMODULE
