! RAPID Kernel, Conditional arguments: two of one group at run time are the error ERR_ARGDUPCND.
MODULE conditional_clash
  PROC main()
    outer\a;
    outer\a\b;
  ENDPROC

  PROC outer(\switch a\switch b)
    inner\left?a\right?b;                 ! stops: two optional arguments that exclude each other are given (ERR_ARGDUPCND)
    TPWrite "one";                        ! -> one
  ENDPROC

  PROC inner(\switch left|switch right)
  ENDPROC
ENDMODULE
