! RAPID Overview, Error recovery: a long string is an error where it is made.
MODULE string_to_value
  VAR string text:="0123456789012345678901234567890123456789";

  PROC main()
    text:=text+text+"!";
    TPWrite "length "\Num:=StrLen(text);        ! -> length 40
  ERROR
    IF ERRNO=ERR_STRTOOLNG TRYNEXT;
  ENDPROC
ENDMODULE
