! RAPID Kernel, Error recovery: TRYNEXT behind a RETURN that failed; then the function needs another.
MODULE function_goes_on
  VAR num zero;

  PROC main()
    TPWrite ValToStr(ratio(1,zero));      ! -> 0
    TPWrite ValToStr(forgets(1,zero));
  ENDPROC

  FUNC num ratio(num a,num b)
    RETURN a/b;
    RETURN 0;
  ERROR
    TRYNEXT;
  ENDFUNC

  FUNC num forgets(num a,num b)
    RETURN a/b;
  ERROR
    TRYNEXT;
  ENDFUNC                                 ! stops: the function forgets ended without RETURN (ERR_FNCNORET)
ENDMODULE
