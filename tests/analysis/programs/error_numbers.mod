MODULE error_numbers
  VAR errnum ERR_OWN:=-1;
  VAR num n;
  PROC main()
    n:=1/n;
  ERROR
    IF ERRNO=1135 TRYNEXT;                ! warning: F414
    IF 50204<>ERRNO TRYNEXT;              ! warning: F414
    IF ERRNO=ERR_DIVZERO OR ERRNO=7 OR ERRNO=ERR_OWN TRYNEXT;
    IF ERRNO=0 RETURN;
    TEST ERRNO
    CASE ERR_OUTOFBND, 90:
      TRYNEXT;
    CASE ERR_OWN, 1074:                   ! warning: F414
      RETRY;
    ENDTEST
  ENDPROC
  PROC other()
    VAR num ERRNO;
    IF ERRNO=1135 n:=1;
  ENDPROC
ENDMODULE
