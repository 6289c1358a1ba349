! RAPID Kernel, String operators: + joins, = and <> compare; there is no order.
MODULE string_operators
  VAR string s:="ab";

  PROC main()
    s:=s+"c"+s;
    TPWrite s;                            ! -> abcab
    TPWrite ValToStr(s="abcab");          ! -> TRUE
    TPWrite ValToStr("a"<>"A");           ! -> TRUE
    TPWrite ValToStr(StrOrder("a","b",STR_UPPER)); ! -> TRUE
    TPWrite StrMap("Größe 1",STR_LOWER,STR_UPPER); ! -> GRÖßE 1
  ENDPROC
ENDMODULE
