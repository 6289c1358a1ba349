! RAPID Kernel, Conditional arguments: \a?b passes a on where the caller's b is present.
MODULE conditional_arguments
  PROC main()
    outer;
    outer\fast;
    outer\height:=7\fast;
  ENDPROC

  PROC outer(\switch fast\num height)
    inner\quick?fast\lift?height;
  ENDPROC

  PROC inner(\switch quick\num lift)
    VAR string text:="inner";
    IF Present(quick) text:=text+" quick";
    IF Present(lift) text:=text+" lift "+ValToStr(lift);
    TPWrite text;
    ! -> inner
    ! -> inner quick
    ! -> inner quick lift 7
  ENDPROC
ENDMODULE
