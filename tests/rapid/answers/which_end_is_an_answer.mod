! RAPID Overview, Error recovery: a clause that comes to its end answers where it has done something.
MODULE which_end_is_an_answer
  VAR num zero;
  VAR bool failed;
  VAR intnum soon;

  PROC main()
    nothing_at_all;
    a_text;
    a_text_before_the_branches;
    a_text_behind_the_branches;
    a_flag_before_the_branches;
    a_branch_that_tells;
    another_branch;
    an_empty_else;
    no_retry_left;
    by_a_test;
    of_a_trap;
  ENDPROC

  PROC nothing_at_all()
    zero:=1/zero;                       ! answered: ERR_DIVZERO fell through by nothing_at_all
  ERROR
  ENDPROC

  PROC a_text()
    zero:=1/zero;                       ! answered: ERR_DIVZERO returned by a_text
  ERROR
    TPWrite "failed";                   ! -> failed
  ENDPROC

  PROC a_text_before_the_branches()
    zero:=1/zero;
    ! answered: ERR_DIVZERO fell through by a_text_before_the_branches
  ERROR
    TPWrite "failed";                   ! -> failed
    IF ERRNO=ERR_OUTOFBND RETRY;
  ENDPROC

  PROC a_text_behind_the_branches()
    zero:=1/zero;
    ! answered: ERR_DIVZERO returned by a_text_behind_the_branches
  ERROR
    IF ERRNO=ERR_OUTOFBND RETRY;
    TPWrite "failed";                   ! -> failed
  ENDPROC

  PROC a_flag_before_the_branches()
    zero:=1/zero;
    ! answered: ERR_DIVZERO returned by a_flag_before_the_branches
  ERROR
    failed:=TRUE;
    IF ERRNO=ERR_OUTOFBND RETRY;
  ENDPROC

  PROC a_branch_that_tells()
    zero:=1/zero;
    ! answered: ERR_DIVZERO returned by a_branch_that_tells
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      TPWrite "division";               ! -> division
    ENDIF
    IF ERRNO=ERR_OUTOFBND RETRY;
  ENDPROC

  PROC another_branch()
    zero:=1/zero;                       ! answered: ERR_DIVZERO fell through by another_branch
  ERROR
    IF ERRNO=ERR_OUTOFBND THEN
      TPWrite "index";
    ELSEIF ERRNO=ERR_WAIT_MAXTIME THEN
      failed:=TRUE;
    ENDIF
  ENDPROC

  PROC an_empty_else()
    zero:=1/zero;                       ! answered: ERR_DIVZERO fell through by an_empty_else
  ERROR
    IF ERRNO=ERR_OUTOFBND THEN
      RETRY;
    ELSE
      ! nothing for the others
    ENDIF
  ENDPROC

  PROC no_retry_left()
    VAR num left:=2;
    zero:=1/zero;
    ! answered: ERR_DIVZERO retried by no_retry_left 2 times
    ! answered: ERR_DIVZERO fell through by no_retry_left
  ERROR
    IF ERRNO=ERR_DIVZERO THEN
      IF left>0 THEN
        left:=left-1;
        RETRY;
      ENDIF
    ENDIF
  ENDPROC

  PROC by_a_test()
    zero:=1/zero;                       ! answered: ERR_DIVZERO fell through by by_a_test
  ERROR
    TEST ERRNO
    CASE ERR_OUTOFBND,ERR_WAIT_MAXTIME:
      TRYNEXT;
    CASE ERR_FILEOPEN:
      TPWrite "file";
    ENDTEST
  ENDPROC

  PROC of_a_trap()
    CONNECT soon WITH tick;
    ITimer\Single,0.1,soon;
    WaitTime 0.3;
  ENDPROC

  TRAP tick
    zero:=1/zero;                       ! answered: ERR_DIVZERO next by tick
  ERROR
    TRYNEXT;
  ENDTRAP
ENDMODULE
