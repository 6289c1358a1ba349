! RAPID Kernel, String literals: a backslash begins \\ or two hexadecimal digits, nothing else.
MODULE string_escape
  CONST string path:="C:\temp";          ! error: E116
  CONST string bell:="\07";
ENDMODULE
