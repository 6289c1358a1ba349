! RAPID Kernel, Storage class: VAR, PERS and CONST; the scope word comes first.
MODULE storage
  VAR num variable:=1;
  PERS num persistent:=2;
  CONST num constant:=3;
  LOCAL VAR num hidden:=4;
  LOCAL PERS num kept:=5;
  LOCAL CONST num fixed:=6;
  TASK VAR num of_task:=7;
  TASK PERS num shared:=8;

  PROC main()
    variable:=variable+persistent;
    persistent:=variable+constant;
    TPWrite ValToStr(persistent);     ! -> 6
    hidden:=hidden+kept+fixed+of_task+shared;
    TPWrite ValToStr(hidden);         ! -> 30
  ENDPROC
ENDMODULE
