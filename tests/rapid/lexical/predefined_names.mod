! RAPID Kernel, Scope rules: names of types, instructions and data are not reserved.
MODULE predefined_names
  VAR num pos:=1;
  VAR num high:=10;
  CONST speeddata v2:=[2,500,5000,1000];

  PROC main()
    TPWrite ValToStr(pos+high);   ! -> 11
    TPWrite ValToStr(v2.v_tcp);   ! -> 2
    Incr;
  ENDPROC

  PROC Incr()
    TPWrite "my own";             ! -> my own
  ENDPROC
ENDMODULE
