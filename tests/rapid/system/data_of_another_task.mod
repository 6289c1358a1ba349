! RAPID Instructions, GetDataVal: \TaskName may name the task itself, but none that is not there.
MODULE data_of_another_task
  VAR num amount:=3;

  PROC main()
    VAR num read;
    GetDataVal "amount"\TaskName:="T_ROB1",read;
    TPWrite ValToStr(read);                 ! -> 3
    GetDataVal "amount"\TaskName:="T_ROB9",read;
    SetDataVal "amount"\TaskName:="T_ROB9",read;
  ERROR
    TPWrite "no task "\Bool:=ERRNO=ERR_TASKNAME;
    ! -> no task TRUE
    ! -> no task TRUE
    TRYNEXT;
  ENDPROC
ENDMODULE
