MODULE example
  PROC main()
    Stop;
  UNDO
    Reset doGrip;
  UNDO ! found
    Reset doClamp;
  ENDPROC
ENDMODULE
