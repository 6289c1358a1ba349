! RAPID Kernel, Error recovery: an error that nobody handles stops the program.
MODULE unhandled
  PROC main()
    TPWrite "before";                   ! -> before
    inner;
    TPWrite "never";
  ENDPROC

  PROC inner()
    RAISE 5;                            ! stops: the program raised error 5
  ENDPROC
ENDMODULE
