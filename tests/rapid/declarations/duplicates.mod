! RAPID Kernel, Scope rules: one scope has one thing of a name, whatever its kind.
MODULE duplicates
  VAR num A;
  VAR num a;                      ! error: N202
  PROC same()
  ENDPROC
  VAR num same;                   ! error: N202

  PROC main(num x\num X)          ! error: N202
    VAR num y;
    CONST string Y:="";           ! error: N202
    twice:
    twice:                        ! error: N202
    y:=x;
  ENDPROC
ENDMODULE
