! RAPID Instructions, BookErrNo: a number of the program's own; the manual's name for it is nobody's.
MODULE booked_and_raised
  VAR errnum ERR_GLUEFLOW:=-1;
  VAR bool flows;

  PROC main()
    BookErrNo ERR_GLUEFLOW;
    flows:=ERR_GLUEFLOW<0;
    IF NOT flows RAISE ERR_GLUEFLOW;
    TPWrite "never";
  ERROR
    IF ERRNO=ERR_GLUEFLOW THEN
      ErrWrite "Glue flow","No glue"\RL2:="Fill up";  ! -> error Glue flow: No glue / Fill up
      RETURN;
    ENDIF
  ENDPROC
ENDMODULE
