! RAPID Functions, CRobT: a task without a robot asks for that of the task it belongs to.
MODULE back
  PROC back_main()
    VAR jointtarget j;
    WaitTime 0.1;
    j:=CJointT();
    TPWrite ValToStr(j.robax.rax_5);        ! -> 30
    j:=CJointT(\TaskName:="T_BACK");
    TPWrite "own";                          ! -> own
  ENDPROC
ENDMODULE
