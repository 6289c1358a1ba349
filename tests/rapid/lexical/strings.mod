! RAPID Kernel, String literals: "" is a quote, \\ a backslash, \HH a character by its code.
MODULE strings
  PROC main()
    TPWrite "plain";            ! -> plain
    TPWrite "a""b";             ! -> a"b
    TPWrite "C:\\temp";         ! -> C:\temp
    TPWrite "\41\42\43";        ! -> ABC
    TPWrite ValToStr(StrLen("\0D\0A")); ! -> 2
    TPWrite ValToStr(StrLen("""")); ! -> 1
    TPWrite "";                 ! ->
    TPWrite "! ; := ENDMODULE <SMT>"; ! -> ! ; := ENDMODULE <SMT>
  ENDPROC
ENDMODULE
