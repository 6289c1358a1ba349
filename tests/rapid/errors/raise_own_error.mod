! RAPID Kernel, RAISE: a number from 1 to 90, or one that was booked.
MODULE raise_own_error
  CONST errnum ERR_EMPTY:=17;
  VAR errnum ERR_GRIP:=-1;

  PROC main()
    BookErrNo ERR_GRIP;
    RAISE ERR_EMPTY;
    RAISE ERR_GRIP;
    RAISE 90;
    RAISE ERR_PATH_STOP;
    TPWrite "done";                     ! -> done
  ERROR
    TEST ERRNO
    CASE ERR_EMPTY:
      TPWrite "empty";                  ! -> empty
    CASE ERR_GRIP:
      TPWrite "grip";                   ! -> grip
    CASE 90:
      TPWrite "ninety";                 ! -> ninety
    DEFAULT:
      TPWrite "another";                ! -> another
    ENDTEST
    TRYNEXT;
  ENDPROC
ENDMODULE
