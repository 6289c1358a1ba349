! RAPID Kernel, Optional parameters: they have modes too, and are passed on as they came.
MODULE optional_by_reference
  VAR num n:=1;
  PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];

  PROC main()
    outer;
    outer\result:=n;
    TPWrite ValToStr(n);                  ! -> 42
    length;
    length\tool:=tGrip;
  ENDPROC

  PROC outer(\INOUT num result)
    inner\answer?result;
  ENDPROC

  PROC inner(\VAR num answer)
    IF NOT Present(answer) RETURN;
    answer:=42;
  ENDPROC

  PROC length(\PERS tooldata tool)
    IF Present(tool) THEN
      TPWrite ValToStr(tool.tframe.trans.z);  ! -> 100
    ELSE
      TPWrite "no tool";                  ! -> no tool
    ENDIF
  ENDPROC
ENDMODULE
