! RAPID Overview, Error recovery: ERRNO keeps the last error's number until the next.
MODULE number_outside
  PROC main()
    TPWrite ValToStr(ERRNO=0);            ! -> TRUE
    attempt;
    TPWrite ValToStr(ERRNO);              ! -> 8
  ENDPROC

  PROC attempt()
    RAISE 8;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
