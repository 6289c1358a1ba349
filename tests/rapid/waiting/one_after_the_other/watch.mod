! RAPID Instructions, WaitTestAndSet: waits for what TestAndSet has taken.
MODULE watch
  PERS bool pendant_in_use:=FALSE;

  PROC main()
    VAR num here;
    VAR num moving;
    TPWrite GetTaskName(\TaskNo:=here\MecTaskNo:=moving)+" "\Num:=here*10+moving;  ! -> T_WATCH 20
    TPWrite ValToStr(TaskRunMec())+" "+ValToStr(TaskRunRob());                     ! -> FALSE FALSE
    WaitTime 0.5;
    WaitTestAndSet pendant_in_use;
    TPWrite "first line of the watcher at "\Num:=GetTime(\Sec);                    ! -> first line of the watcher at 2
    pendant_in_use:=FALSE;
    WaitTime 100;
  ENDPROC
ENDMODULE
