MODULE example
  PROC main()
    VAR num parts:=0;
    VAR num each;
    IF parts>0 THEN
      each:=100/parts;
    ENDIF
  ENDPROC
ENDMODULE
