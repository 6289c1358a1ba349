! RAPID Kernel, Module declarations: types, data and routines stand in any order.
MODULE order_of_items
  PROC main()
    last.size:=2;
    TPWrite ValToStr(last.size*FACTOR); ! -> 6
  ENDPROC

  VAR box last;
  CONST num FACTOR:=3;
  RECORD box
    num size;
  ENDRECORD
ENDMODULE
