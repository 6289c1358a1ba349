! RAPID Kernel, Functions: reaching the end without a value is the error ERR_FNCNORET.
MODULE function_without_return
  PROC main()
    TPWrite ValToStr(positive(1));        ! -> 1
    TPWrite ValToStr(positive(-1));
  ENDPROC

  FUNC num positive(num n)
    IF n>0 RETURN n;
  ENDFUNC                                 ! warning: F404 ! stops: the function positive ended without RETURN (ERR_FNCNORET)
ENDMODULE
