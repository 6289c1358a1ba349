! RAPID Overview, Error numbers: programs compare ERRNO with names.
MODULE error_names
  VAR num zero;
  VAR num list{2};
  VAR string s:="1234567890123456789012345678901234567890X";
  VAR num n;

  PROC main()
    n:=1/zero;
    n:=list{zero+3};
    n:=7.5 DIV 2;
    s:=s+s;
    n:=Sqrt(-1);
    optional;
    %"nothing"%;
    n:=forgets();
  ERROR
    TEST ERRNO
    CASE ERR_DIVZERO:
      TPWrite "division by zero";       ! -> division by zero
    CASE ERR_OUTOFBND:
      TPWrite "index";                  ! -> index
    CASE ERR_NOTINTVAL,ERR_INT_NOTVAL:
      TPWrite "not whole";              ! -> not whole
    CASE ERR_STRTOOLNG:
      TPWrite "string";                 ! -> string
    CASE ERR_ARGVALERR:
      TPWrite "argument";               ! -> argument
    CASE ERR_NOTPRES:
      TPWrite "not present";            ! -> not present
    CASE ERR_REFUNKPRC:
      TPWrite "no procedure";           ! -> no procedure
    CASE ERR_FNCNORET:
      TPWrite "no return";              ! -> no return
    ENDTEST
    TRYNEXT;
  ENDPROC

  PROC optional(\num n)
    list{1}:=n;
  ENDPROC

  FUNC num forgets()
    IF zero=1 RETURN 1;
  ENDFUNC                               ! warning: F404
ENDMODULE
