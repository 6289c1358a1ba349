MODULE example
  VAR num count:=3;
  PROC main()
    TPWrite "parts: "+count; ! found
  ENDPROC
ENDMODULE
