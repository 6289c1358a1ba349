! RAPID Kernel, RAISE: another number is the error ERR_ILLRAISE.
MODULE raise_illegal_number
  PROC main()
    RAISE 500;
    RAISE 0;                            ! stops: RAISE 0: allowed are 1 to 90, booked numbers and ERR_ names (ERR_ILLRAISE)
  ERROR
    IF ERRNO=ERR_ILLRAISE THEN
      IF handled() RAISE;
      TRYNEXT;
    ENDIF
  ENDPROC

  VAR num count;

  FUNC bool handled()
    count:=count+1;
    RETURN count>1;
  ENDFUNC
ENDMODULE
