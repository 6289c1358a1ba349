! RAPID Functions, CRobT: of another task; one without a robot, and one that is not there, are errors.
MODULE position_of_another_task
  PROC main()
    VAR robtarget p;
    VAR jointtarget j;
    j:=CJointT(\TaskName:="T_ROB1");
    TPWrite ValToStr(j.robax.rax_5);        ! -> 30
    p:=CRobT(\TaskName:="T_NOBODY"\Tool:=tool0\WObj:=wobj0);
    p:=CRobT(\TaskName:="T_BACK"\Tool:=tool0\WObj:=wobj0);
    j:=CJointT(\TaskName:="T_BACK");
  ERROR
    IF ERRNO=ERR_TASKNAME TPWrite "no task"; ! -> no task
    IF ERRNO=ERR_NOT_MOVETASK TPWrite "no robot"; ! -> no robot ! -> no robot
    TRYNEXT;
  ENDPROC
ENDMODULE
