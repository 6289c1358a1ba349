! RAPID Kernel, Functions: an ERROR clause that comes to its end leaves a function without a value.
MODULE clause_of_a_function_ends
  VAR num zero:=0;

  PROC main()
    TPWrite ValToStr(part(1));              ! -> 0
    TPWrite ValToStr(share(1));
  ENDPROC

  FUNC num part(num whole)
    RETURN whole/zero;
  ERROR
    ! Complete for the only error there is.
    IF ERRNO=ERR_DIVZERO RETURN 0;
  ENDFUNC

  FUNC num share(num whole)
    RETURN whole/zero;
  ERROR                                     ! warning: F404
    TPWrite "no share";                     ! -> no share
  ENDFUNC                                   ! stops: the function share ended without RETURN (ERR_FNCNORET)
ENDMODULE
