MODULE example
  PROC main()
    WaitTime 1; ! rapidsim: ignore[T309] checked by hand ! found
  ENDPROC
ENDMODULE
