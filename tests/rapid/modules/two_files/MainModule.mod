! RAPID Kernel, Scope rules: global items of all modules of a task are seen everywhere.
MODULE MainModule
  LOCAL PROC report()
    TPWrite "of MainModule";            ! -> of MainModule
  ENDPROC

  PROC main()
    report;
    tool_report;
    shared:=shared+1;
    TPWrite ValToStr(shared);           ! -> 2
    TPWrite ValToStr(next.number);      ! -> 7
    %"Tools:hidden_report"%;
  ENDPROC
ENDMODULE
