MODULE example
  PROC main()
    TPWrite "The gripper did not report that it has closed";
    TPWrite "within the time it should take: look";
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  CONST string dashes:="----------------------------------------";
  VAR string text;
  PROC main()
    text:=dashes+dashes;
    text:=StrPart(text,1,40)+StrPart(dashes+dashes,1,40)+dashes;
    reg1:=1+2+3;
  ENDPROC
ENDMODULE
