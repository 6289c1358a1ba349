! RAPID Overview, Error recovery: a function's clause may return a value of its own.
MODULE functions_return_a_stand_in
  VAR num zero;

  PROC main()
    TPWrite "share "\Num:=share(10,4);  ! -> share 2.5
    TPWrite "share "\Num:=share(10,0);  ! -> share 0
  ENDPROC

  FUNC num share(num whole,num parts)
    RETURN whole/parts;
  ERROR
    IF ERRNO=ERR_DIVZERO RETURN 0;
  ENDFUNC
ENDMODULE
