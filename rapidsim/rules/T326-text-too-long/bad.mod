MODULE example
  PROC main()
    TPWrite "The gripper did not report that it has closed "+"within the time it should take: look"; ! found
  ENDPROC
ENDMODULE
! ---
MODULE bad
  CONST string head:="The gripper did not report that it has closed ";
  VAR string text;
  PROC main()
    text:=head+("within "+NumToStr(reg1,0)+" s. ")+"Look for a part in it, then go on."; ! found
  ENDPROC
ENDMODULE
