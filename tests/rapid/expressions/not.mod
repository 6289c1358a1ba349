! RAPID Kernel, Expressions: NOT binds looser than AND, so NOT a AND b is NOT (a AND b).
MODULE nots
  VAR bool yes:=TRUE;
  VAR bool no:=FALSE;

  PROC main()
    TPWrite ValToStr(NOT no AND no);      ! -> TRUE
    TPWrite ValToStr((NOT no) AND no);    ! -> FALSE
    TPWrite ValToStr(NOT yes OR yes);     ! -> TRUE
    TPWrite ValToStr(yes OR NOT yes);     ! -> TRUE
    TPWrite ValToStr(yes AND NOT no);     ! -> TRUE
    TPWrite ValToStr(NOT yes=no);         ! -> TRUE
  ENDPROC
ENDMODULE
