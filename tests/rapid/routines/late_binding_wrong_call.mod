! RAPID Kernel, Late binding: what is found must be a procedure with these parameters.
MODULE late_binding_wrong_call
  PROC main()
    VAR string name:="one";
    attempt "half";
    attempt "one";
    %name% "text";                        ! stops: "one" cannot be called like this: n takes num, not string (ERR_CALLPROC)
  ENDPROC

  PROC attempt(string name)
    %name%;
    TPWrite "not "+name;
    ! -> not half
    ! -> not one
  ERROR
    IF ERRNO=ERR_CALLPROC TRYNEXT;
  ENDPROC

  PROC one(num n)
  ENDPROC

  FUNC num half(num of)
    RETURN of/2;
  ENDFUNC
ENDMODULE
