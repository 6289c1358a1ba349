! RAPID Kernel, Error recovery: TRYNEXT goes on behind the statement that failed.
MODULE try_next
  VAR num zero;
  VAR num n:=1;

  PROC main()
    n:=1/zero;
    TPWrite "went on with "\Num:=n;     ! -> went on with 1
    IF 1/zero=1 THEN
      TPWrite "never";
    ELSE
      TPWrite "never";
    ENDIF
    FOR i FROM 1 TO 1/zero DO
      TPWrite "never";
    ENDFOR
    TPWrite "behind the blocks";        ! -> behind the blocks
  ERROR
    IF ERRNO=ERR_DIVZERO TRYNEXT;
  ENDPROC
ENDMODULE
