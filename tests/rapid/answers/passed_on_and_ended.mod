! RAPID Overview, Error recovery: an error that no clause takes ends the program.
MODULE passed_on_and_ended
  VAR num zero;
  VAR errnum errGrip:=-1;

  PROC main()
    BookErrNo errGrip;
    pick;
  ERROR
    IF ERRNO=errGrip THEN
      RAISE 5;
      ! answered: 5 ended the program ! stops: the program raised error 5
    ENDIF
  ENDPROC

  PROC pick()
    grip;
  ERROR
    RAISE errGrip;
    ! answered: errGrip raised by main
  ENDPROC

  PROC grip()
    zero:=1/zero;                       ! answered: ERR_DIVZERO raised by pick
  ENDPROC
ENDMODULE
