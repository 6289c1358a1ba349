! RAPID Kernel, Data type string: joining beyond 80 characters is an error.
MODULE string_too_long
  VAR string s:="1234567890123456789012345678901234567890";

  PROC main()
    s:=s+s;
    TPWrite ValToStr(StrLen(s));          ! -> 80
    s:=s+"1";                             ! stops: the string has 81 characters, 80 are allowed (ERR_STRTOOLNG)
  ENDPROC
ENDMODULE
