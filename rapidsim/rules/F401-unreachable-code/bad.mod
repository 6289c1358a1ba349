MODULE example
  PROC main()
    TPErase;
    RETURN;
    TPWrite "done"; ! found
  ENDPROC
ENDMODULE
