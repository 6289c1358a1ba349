! RAPID Functions, TestAndSet: of two tasks that want the same thing, one waits for the other.
MODULE robot
  PERS bool pendant_in_use:=FALSE;

  PROC main()
    VAR num here;
    VAR num moving;
    TPWrite GetTaskName(\TaskNo:=here\MecTaskNo:=moving)+" "\Num:=here*10+moving;  ! -> T_ROB1 11
    TPWrite ValToStr(TaskRunMec())+" "+ValToStr(TaskRunRob());                     ! -> TRUE TRUE
    WaitUntil TestAndSet(pendant_in_use);
    TPWrite "first line of the robot at "\Num:=GetTime(\Sec);                      ! -> first line of the robot at 0
    WaitTime 2;
    TPWrite "second line of the robot at "\Num:=GetTime(\Sec);                     ! -> second line of the robot at 2
    pendant_in_use:=FALSE;
    WaitTime 2;
  ENDPROC
ENDMODULE
