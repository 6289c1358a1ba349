MODULE example
  VAR num parts;
  PROC main()
    IF parts=0 CONTINUE; ! found
    TPWrite ValToStr(parts);
  ENDPROC
ENDMODULE
