! RAPID Kernel, Persistent declarations: the initial value is written out in literals.
MODULE persistents
  CONST num one:=1;
  PERS num counter:=-1;
  PERS num counts{3}:=[1,2,3];
  PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS num computed:=1+1;         ! error: T311
  PERS num copied:=one;           ! error: T311
ENDMODULE
