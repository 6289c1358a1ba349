MODULE example
  TASK PERS gluegundata gun1:=[1,5,[0,0]]; ! found
ENDMODULE
! ---
MODULE example
  FUNC gluegundata gun() ! found
    RETURN [1,5,[0,0]];
  ENDFUNC
  PROC main()
    spray [1,5,[0,0]];
  ENDPROC
  PROC spray(gluegundata gun) ! found
  ENDPROC
ENDMODULE
