! RAPID Kernel, Constant declarations: a value, not of itself, and for good.
MODULE constants_wrong
  CONST num a:=5;
  CONST num missing;              ! error: T321
  CONST num hen:=egg;             ! error: T322
  CONST num egg:=hen+1;
  CONST pos place:=[1,2,3];

  PROC main()
    a:=5;                         ! error: T304
    place.x:=1;                   ! error: T304
  ENDPROC
ENDMODULE
