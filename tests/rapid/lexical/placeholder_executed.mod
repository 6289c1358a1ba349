! RAPID Kernel, Placeholders: executing one is an error.
MODULE placeholder_executed
  PROC main()
    TPWrite "before";           ! -> before
    <SMT>                       ! warning: E148 ! stops: the program is unfinished here: a placeholder was reached (ERR_EXECPHR)
    TPWrite "never";
  ENDPROC
ENDMODULE
