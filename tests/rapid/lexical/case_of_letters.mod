! RAPID Kernel, Identifiers: words and names compare without regard to case.
module CASES
  var Num counter:=1;

  proc MAIN()
    COUNTER:=Counter+1;
    If counter=2 Then
      tpwrite "two";      ! -> two
    endIF
    TPWRITE VALTOSTR(True); ! -> TRUE
    SHOW;
  endproc

  PROC Show()
    TPWrite "shown";      ! -> shown
  EndProc
ENDMODULE
