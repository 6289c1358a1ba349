! RAPID Kernel, Constant expressions: they are worked out before anything runs.
MODULE b
  CONST num size:=10;
  CONST num count:=3;

  PROC a_routine()
    VAR num here{count};
    here{count}:=total;
    TPWrite ValToStr(here);               ! -> [0,0,30]
  ENDPROC
ENDMODULE
