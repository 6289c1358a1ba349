! RAPID Kernel, Logical operators: AND, OR, XOR and NOT take bool.
MODULE logic
  VAR bool yes:=TRUE;
  VAR bool no;

  PROC main()
    TPWrite ValToStr(yes XOR yes);        ! -> FALSE
    TPWrite ValToStr(yes XOR no);         ! -> TRUE
    TPWrite ValToStr(yes OR no XOR yes);  ! -> FALSE
    TPWrite ValToStr(no OR yes AND no);   ! -> FALSE
    TPWrite ValToStr(yes=no);             ! -> FALSE
    TPWrite ValToStr(yes<>no);            ! -> TRUE
  ENDPROC
ENDMODULE
