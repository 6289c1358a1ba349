! RAPID Kernel, Optional parameters: reading one that was not given is the error ERR_NOTPRES.
MODULE optional_absent
  PROC main()
    TPWrite ValToStr(half(4\by:=4));      ! -> 1
    TPWrite ValToStr(half(4));
  ENDPROC

  FUNC num half(num n\num by)
    RETURN n/by;                          ! stops: the optional argument by is used but was not given (ERR_NOTPRES)
  ENDFUNC
ENDMODULE
