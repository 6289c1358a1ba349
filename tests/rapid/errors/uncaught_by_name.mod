! RAPID Kernel, RAISE: an error that nobody catches is told by its name, where it was raised.
MODULE uncaught_by_name
  VAR errnum ERR_GLUE_EMPTY:=-1;

  PROC main()
    BookErrNo ERR_GLUE_EMPTY;
    glue;
  ENDPROC

  PROC glue()
    TPWrite "gluing";                   ! -> gluing
    RAISE ERR_GLUE_EMPTY;               ! stops: the program raised error ERR_GLUE_EMPTY
  ENDPROC
ENDMODULE
